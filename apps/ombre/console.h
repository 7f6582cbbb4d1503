// What the user sees: data on stdout, everything for people on stderr, or events for programs.
#pragma once

#include <string>

#include "jobs/common/data_events.h"
#include "ombre/host.h"

namespace ombre::cli {

enum class Voice {
  people,    // words and a progress bar on stderr
  quiet,     // errors alone
  programs,  // one JSON object a line on stdout
};

class Console final : public jobs::Events {
 public:
  explicit Console(const Host& host);
  void set_voice(Voice voice) { voice_ = voice; }
  Voice voice() const { return voice_; }

  bool wants_data() const override { return voice_ == Voice::programs; }
  // On stdout, whatever the voice.
  void print(const std::string& text) const override { data_.print(text); }
  bool prints_among_events() const override { return wants_data(); }
  // Nothing for people.
  void event(const std::string& name, DataMembers members) const override;
  // Without line end.
  void say(const Phrase& text) const override;
  void warn(const Phrase& message, Code code = Code::design) const override;
  void error(Code code, const Phrase& message, const CodeValues& values = {}) const override;
  void diagnose(const Diagnostics& diagnostics) const override;
  std::unique_ptr<jobs::ShownProgress> progress(jobs::Counted counted) const override;

  // Whether stderr is a terminal that a line can be redrawn on.
  bool is_terminal() const;
  bool has_colour() const;

 private:
  Voice voice_ = Voice::people;
  FrontEnd front_end_ = FrontEnd::command_line;
  jobs::DataEvents data_;
};

}  // namespace ombre::cli
