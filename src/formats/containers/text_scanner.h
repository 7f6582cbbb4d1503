// Reads words and numbers out of a text format, with messages that point at the word that is wrong.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/math/vec.h"
#include "base/text/diagnostic.h"

namespace ombre::formats {

// Reports about a file without pointing into it, and ends its reading by DesignError.
[[noreturn]] void fail(Diagnostics& diagnostics, const std::string& name, const std::string& message,
                       std::string hint = "");

// A word as a message shows it: in quotes, shortened, printable.
std::string quoted(std::string_view word, size_t longest = 40);

// Failures are reported and end the reading by DesignError; each reader catches it at its entrance.
class TextScanner {
 public:
  struct Syntax {
    char comment = '\0';           // from here to the line's end; NUL: there are none
    bool continues_lines = false;  // a backslash at a line's end joins the next line
  };

  TextScanner(const std::string& name, std::string_view bytes, Diagnostics& diagnostics, Syntax syntax);
  TextScanner(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : TextScanner(name, bytes, diagnostics, Syntax{}) {}

  size_t position() const { return at_; }
  void go_to(size_t position) { at_ = position; }
  size_t remaining() const { return bytes_.size() - at_; }
  bool at_end();       // past blanks, empty lines and comments
  bool at_line_end();  // past blanks and comments
  void next_line();    // past the rest of this line
  // Whether so many lines with words follow, what is left of this one among them.
  bool has_lines(uint64_t count) const;

  std::string_view word();          // in this line or a later one; empty at the end
  std::string_view word_in_line();  // empty at the line's end
  std::string_view rest_of_line();  // trimmed; the line end stays

  // The next number in any line, also as FORTRAN programs write them (1.5D+02, 1.5+102), or with a decimal comma, which
  // is warned of. `what` is for the message: "the x of a vertex".
  double number(std::string_view what);
  // One that fits a vertex: finite, within greatest_coordinate.
  double coordinate(std::string_view what);
  Vec3 point(std::string_view what);
  // A whole number of at least 0.
  uint64_t count(std::string_view what);

  // Points at bytes [begin, end), at the last word, or at where the scanner stands.
  [[noreturn]] void fail_at(size_t begin, size_t end, const std::string& message, std::string hint = "") const;
  [[noreturn]] void fail_at_word(const std::string& message, std::string hint = "") const;
  [[noreturn]] void fail_here(const std::string& message, std::string hint = "") const;

 private:
  double unusual_number(std::string_view text, std::string_view what);
  void skip_blanks();
  bool skip_continuation();
  [[noreturn]] void fail_number(std::string_view what) const;

  std::string name_;
  std::string_view bytes_;
  Diagnostics& diagnostics_;
  Syntax syntax_;
  size_t at_ = 0;
  size_t word_begin_ = 0, word_end_ = 0;
  bool has_commas_ = false;
};

}  // namespace ombre::formats
