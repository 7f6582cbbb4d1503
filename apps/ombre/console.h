// What the user sees: data on stdout, everything for people on stderr, or events for programs.
#pragma once

#include <functional>
#include <string>

#include "base/system/progress.h"
#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::cli {

enum class Voice {
  people,    // words and a progress bar on stderr
  quiet,     // errors alone
  programs,  // one JSON object a line on stdout
};

struct Host;

class Console {
 public:
  Console() = default;
  explicit Console(const Host& host);
  void set_voice(Voice voice) { voice_ = voice; }
  Voice voice() const { return voice_; }

  // Result of a command, on stdout whatever the voice.
  void print(const std::string& text) const;
  // {"event": name, ...members} for programs, nothing for others.
  void event(const std::string& name, DataMembers members) const;
  // A remark for people, without line end.
  void say(const Phrase& text) const;
  // Programs get them as events.
  void warn(const Phrase& message, Code code = Code::design) const;
  void error(Code code, const Phrase& message, const CodeValues& values = {}) const;
  void diagnose(const Diagnostics& diagnostics) const;

  // Whether stderr is a terminal that a line can be redrawn on.
  bool is_terminal() const;
  bool has_colour() const;

 private:
  // Returns what --json prints of a diagnostic beside its severity.
  DataMembers members_of(const Diagnostic& diagnostic) const;

  Voice voice_ = Voice::people;
  FrontEnd front_end_ = FrontEnd::command_line;
  std::function<void(const DataMembers&)> on_event_;  // in place of stdout
  std::function<void(const std::string&)> on_data_;
};

}  // namespace ombre::cli
