// Messages to a designer about a design: where, what was expected, what to write instead.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text/code.h"
#include "base/text/phrase.h"
#include "base/text/source_text.h"

namespace ombre {

enum class Severity { note, warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  SourceRange where;
  std::string message;  // one sentence, lower case, no full stop
  Phrase hint;          // what to write instead; may be empty
  Code code = Code::design;
  CodeValues values = {};  // what the message is about, as code.cpp lists them

  bool operator==(const Diagnostic&) const = default;
};

// Collects what is found, so that one run reports several mistakes.
class Diagnostics {
 public:
  static constexpr size_t most = 20;  // errors kept; the rest are counted

  void add(Diagnostic diagnostic);
  void add_all(const Diagnostics& others);
  // Adds diagnostics that are not in the list yet; a job may find the same ones each time it lowers a design.
  void add_new(const Diagnostic& diagnostic);
  void add_new(const Diagnostics& others);
  void error(SourceRange where, std::string message, Phrase hint = {});
  void error(Code code, SourceRange where, std::string message, Phrase hint = {}, CodeValues values = {});
  void warning(SourceRange where, std::string message, Phrase hint = {});
  void warning(Code code, SourceRange where, std::string message, Phrase hint = {}, CodeValues values = {});
  void note(SourceRange where, std::string message);
  // Gives a code to all but the first `count`, where they have none yet, and values to those that have none.
  void tell_code(size_t count, Code code, const CodeValues& values = {});

  const std::vector<Diagnostic>& list() const { return list_; }
  // All but the first `count`, which were reported already.
  Diagnostics after(size_t count) const;
  size_t error_count() const { return error_count_; }
  bool has_errors() const { return error_count_ > 0; }

 private:
  std::vector<Diagnostic> list_;
  size_t error_count_ = 0;
};

// "note", "warning" or "error".
std::string_view name_of(Severity severity);

// What to write instead, in the language of the design that the diagnostic points into.
std::string hint_of(const Diagnostic& diagnostic, FrontEnd front_end = FrontEnd::command_line);
// "message; hint"
std::string sentence_of(const Diagnostic& diagnostic, FrontEnd front_end = FrontEnd::command_line);
// "file:line:column: error: message; hint" ("file: error: ..." for a file as a whole), then the source line and a caret
// line.
std::string to_text(const Diagnostic& diagnostic, FrontEnd front_end = FrontEnd::command_line);
// All of them, and how many more there were.
std::string to_text(const Diagnostics& diagnostics, FrontEnd front_end = FrontEnd::command_line);

// Ends a front end's work early after its diagnostics were recorded.
struct DesignError : std::exception {
  const char* what() const noexcept override { return "the design has errors"; }
};

}  // namespace ombre
