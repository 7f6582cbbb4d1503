// Lines, indentation and blanks of a script's text.
#pragma once

#include <string>
#include <string_view>

#include "lang/edit/replacement.h"

namespace ombre::lang {

class TextLayout {
 public:
  // Constructs a view of a text, which must outlive it.
  explicit TextLayout(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }
  std::string_view between(size_t from, size_t to) const { return text_.substr(from, to - from); }
  char at(size_t place) const { return place < text_.size() ? text_[place] : '\0'; }

  size_t line_begin(size_t place) const;
  size_t line_end(size_t place) const;   // before the end of the line
  size_t next_line(size_t place) const;  // after the end of the line
  // Returns the blanks with which the line of a place begins.
  std::string indent_of(size_t place) const;
  std::string newline() const { return text_.find("\r\n") == std::string_view::npos ? "\n" : "\r\n"; }

  // True if nothing but blanks stands before a place on its line, or after it.
  bool is_first_on_line(size_t place) const;
  bool is_last_on_line(size_t place) const;
  // True if the range has blanks and line ends alone.
  bool is_blank(size_t from, size_t to) const;
  // Returns the place of the first character from `place` on that belongs to no blank and no comment.
  size_t skip_blank(size_t place) const;
  // Returns the end of a comment that is all that follows on the line, else `place`.
  size_t behind_comment(size_t place) const;
  // Returns the end of the blanks on the line from `place` on, and the start of those before it.
  size_t after_blanks(size_t place) const;
  size_t before_blanks(size_t place) const;

  // Returns the line behind the comments with which the text begins, but for the block of a declaration ("///").
  size_t behind_first_comments() const;
  // Returns the begin of the line of a place, or that of the comments right above it, unless these begin the text.
  size_t above_comments(size_t place) const;

  // Returns replacements that give lines other blanks at their beginning: the lines that begin after `from`, and before
  // `to`. Lines that begin with other blanks than `old_indent`, or within a text over several lines, stay.
  Replacements reindent(size_t from, size_t to, const std::string& old_indent, const std::string& new_indent) const;

 private:
  bool begins_in_string(size_t from, size_t line) const;

  std::string_view text_;
};

}  // namespace ombre::lang
