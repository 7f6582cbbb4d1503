// Passes the events of jobs on as data for programs.
#pragma once

#include <functional>

#include "jobs/common/events.h"

namespace ombre::jobs {

// Makes texts in the spelling of a front end. The functions are called from several threads, and must stay callable as
// long as the object exists.
class DataEvents final : public Events {
 public:
  using OnEvent = std::function<void(const DataMembers& event)>;
  using OnText = std::function<void(const std::string& text)>;
  // `on_event` gets {"event": name, ...}, `on_text` results that are text.
  DataEvents(FrontEnd front_end, OnEvent on_event, OnText on_text)
      : front_end_(front_end), on_event_(std::move(on_event)), on_text_(std::move(on_text)) {}

  bool wants_data() const override { return true; }
  void print(const std::string& text) const override { on_text_(text); }
  bool prints_among_events() const override { return false; }
  void event(const std::string& name, DataMembers members) const override;
  void say(const Phrase& /*text*/) const override {}
  void warn(const Phrase& message, Code code = Code::design) const override;
  void error(Code code, const Phrase& message, const CodeValues& values = {}) const override;
  void diagnose(const Diagnostics& diagnostics) const override;
  std::unique_ptr<ShownProgress> progress(Counted counted) const override;

 private:
  FrontEnd front_end_;
  OnEvent on_event_;
  OnText on_text_;
};

}  // namespace ombre::jobs
