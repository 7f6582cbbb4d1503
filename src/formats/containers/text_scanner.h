// Reads words and numbers from a text format; messages point at the invalid word.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/math/vec.h"
#include "base/text/diagnostic.h"

namespace ombre::formats {

// Reports an error in a file without a position, and throws DesignError.
[[noreturn]] void fail(Diagnostics& diagnostics, const std::string& name, const std::string& message,
                       std::string hint = "");

// Returns what `read` makes of the bytes of a file; null, with a diagnostic, if there are none or it throws
// DesignError.
template <class Read>
std::optional<std::invoke_result_t<Read>> read_or_null(const std::string& name, std::string_view bytes,
                                                       Diagnostics& diagnostics, const Read& read) {
  try {
    if (bytes.empty()) fail(diagnostics, name, "the file is empty");
    return read();
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

// Returns a word for messages: in quotes, shortened and printable.
std::string quoted(std::string_view word, size_t longest = 40);

// Scans a text. Errors are reported, and DesignError is thrown; each reader catches it in its outermost function.
// Returns the bytes behind UTF-8's byte order mark, which editors on Windows put at the beginning of files.
std::string_view without_byte_order_mark(std::string_view bytes);

class TextScanner {
 public:
  struct Syntax {
    char comment = '\0';           // begins a comment up to the end of the line; NUL if there are no comments
    bool continues_lines = false;  // a backslash at the end of a line joins the next line
  };

  TextScanner(const std::string& name, std::string_view bytes, Diagnostics& diagnostics, Syntax syntax);
  TextScanner(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : TextScanner(name, bytes, diagnostics, Syntax{}) {}

  size_t position() const { return at_; }
  void go_to(size_t position) { at_ = position; }
  size_t remaining() const { return bytes_.size() - at_; }
  bool at_end();       // true at the end of the text, after skipping blanks, empty lines and comments
  bool at_line_end();  // true at the end of the line, after skipping blanks and comments
  void next_line();    // skips the rest of this line
  // Returns true if at least this many lines with words follow, including the rest of this one.
  bool has_lines(uint64_t count) const;

  std::string_view word();          // in this line or a later one; empty at the end of the text
  std::string_view word_in_line();  // empty at the end of the line
  std::string_view rest_of_line();  // trimmed, without consuming the line end

  // Reads the next number in any line. FORTRAN's forms (1.5D+02, 1.5+102) are accepted, as is a decimal comma, which
  // causes a warning. `what` is used in messages: "the x of a vertex".
  double number(std::string_view what);
  // Reads a coordinate, which must be finite and within greatest_coordinate.
  double coordinate(std::string_view what);
  Vec3 point(std::string_view what);
  // Reads an integer of at least 0.
  uint64_t count(std::string_view what);

  // These report an error at the bytes [begin, end), at the last word, or at the current position.
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
