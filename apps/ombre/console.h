// Output: data on stdout, messages for people on stderr, or events for programs.
#pragma once

#include <string>

#include "jobs/common/data_events.h"
#include "ombre/host.h"

namespace ombre::cli {

enum class Voice {
  people,    // messages and a progress bar on stderr
  quiet,     // errors alone on stderr
  programs,  // one JSON object a line on stdout
};

class Console final : public jobs::Events {
 public:
  explicit Console(const Host& host);
  void set_voice(Voice voice) { voice_ = voice; }
  Voice voice() const { return voice_; }

  bool wants_data() const override { return voice_ == Voice::programs; }
  // Prints to stdout, whatever the voice.
  void print(const std::string& text) const override { data_.print(text); }
  bool prints_among_events() const override { return wants_data(); }
  // Prints an event for programs; people see nothing.
  void event(const std::string& name, DataMembers members) const override;
  // Prints a text without a line end.
  void say(const Phrase& text) const override;
  void warn(const Phrase& message, Code code = Code::design) const override;
  void error(Code code, const Phrase& message, const CodeValues& values = {}) const override;
  void diagnose(const Diagnostics& diagnostics) const override;
  std::unique_ptr<jobs::ShownProgress> progress(jobs::Counted counted) const override;

  // True if stderr is a terminal on which a line can be redrawn.
  bool is_terminal() const;
  bool has_colour() const;

 private:
  Voice voice_ = Voice::people;
  FrontEnd front_end_ = FrontEnd::command_line;
  jobs::DataEvents data_;
};

}  // namespace ombre::cli
