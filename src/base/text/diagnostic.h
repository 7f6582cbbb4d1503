// Messages to a designer about a design: the position, what is wrong, and what to write instead.
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
  std::string message;  // one sentence in lower case without a full stop
  Phrase hint;          // what to write instead; may be empty
  Code code = Code::design;
  CodeValues values = {};  // values named in code.cpp for this code

  bool operator==(const Diagnostic&) const = default;
};

// Collects diagnostics, so that one run reports several errors.
class Diagnostics {
 public:
  static constexpr size_t most = 20;  // number of errors that are kept; further ones are only counted

  void add(Diagnostic diagnostic);
  void add_all(const Diagnostics& others);
  // Adds diagnostics that are not in the list yet. A job may find the same ones each time it lowers a design.
  void add_new(const Diagnostic& diagnostic);
  void add_new(const Diagnostics& others);
  void error(SourceRange where, std::string message, Phrase hint = {});
  void error(Code code, SourceRange where, std::string message, Phrase hint = {}, CodeValues values = {});
  void warning(SourceRange where, std::string message, Phrase hint = {});
  void warning(Code code, SourceRange where, std::string message, Phrase hint = {}, CodeValues values = {});
  void note(SourceRange where, std::string message);
  // Skips the first `count` diagnostics; gives the others the code if they have none, and the values if they have none.
  void tell_code(size_t count, Code code, const CodeValues& values = {});

  const std::vector<Diagnostic>& list() const { return list_; }
  // Returns the diagnostics after the first `count`, which were reported already.
  Diagnostics after(size_t count) const;
  size_t error_count() const { return error_count_; }
  bool has_errors() const { return error_count_ > 0; }

 private:
  std::vector<Diagnostic> list_;
  size_t error_count_ = 0;
};

// Returns "note", "warning" or "error".
std::string_view name_of(Severity severity);

// Returns what to write instead, in the language of the design where the diagnostic lies.
std::string hint_of(const Diagnostic& diagnostic, FrontEnd front_end = FrontEnd::command_line);
// Returns "message; hint".
std::string sentence_of(const Diagnostic& diagnostic, FrontEnd front_end = FrontEnd::command_line);
// Returns "file:line:column: message; hint", or "file: message; hint" for a whole file.
std::string placed_sentence_of(const Diagnostic& diagnostic, FrontEnd front_end = FrontEnd::command_line);
// Returns "file:line:column: error: message; hint" ("file: error: ..." for a whole file), then the source line and a
// marker line.
std::string to_text(const Diagnostic& diagnostic, FrontEnd front_end = FrontEnd::command_line);
// Returns the text of all diagnostics and the number of further errors.
std::string to_text(const Diagnostics& diagnostics, FrontEnd front_end = FrontEnd::command_line);

// Thrown to stop work on a design after its diagnostics were recorded.
struct DesignError : std::exception {
  const char* what() const noexcept override { return "the design has errors"; }
};

}  // namespace ombre
