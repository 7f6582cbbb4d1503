#include "lang/edit/text_layout.h"

#include <algorithm>

#include "base/text/source_text.h"

namespace ombre::lang {
namespace {

bool is_gap(char c) { return c == ' ' || c == '\t'; }
bool is_gap_or_end(char c) { return is_gap(c) || is_line_end(c) || c == '\f' || c == '\v'; }

}  // namespace

size_t TextLayout::line_begin(size_t place) const {
  while (place > 0 && !is_line_end(text_[place - 1])) --place;
  return place;
}

size_t TextLayout::line_end(size_t place) const {
  return std::min(text_.find_first_of(line_ends, place), text_.size());
}

size_t TextLayout::next_line(size_t place) const {
  size_t end = line_end(place);
  if (at(end) == '\r' && at(end + 1) == '\n') ++end;
  return std::min(end + 1, text_.size());
}

std::string TextLayout::indent_of(size_t place) const {
  const size_t begin = line_begin(place);
  return std::string(between(begin, after_blanks(begin)));
}

bool TextLayout::is_first_on_line(size_t place) const { return before_blanks(place) == line_begin(place); }

bool TextLayout::is_last_on_line(size_t place) const { return after_blanks(place) == line_end(place); }

bool TextLayout::is_blank(size_t from, size_t to) const {
  return std::ranges::all_of(between(from, to), is_gap_or_end);
}

size_t TextLayout::skip_blank(size_t place) const {
  while (place < text_.size()) {
    if (is_gap_or_end(text_[place])) {
      ++place;
    } else if (text_.substr(place).starts_with("//")) {
      place = line_end(place);
    } else if (text_.substr(place).starts_with("/*")) {
      const size_t close = text_.find("*/", place + 2);
      place = close == std::string_view::npos ? text_.size() : close + 2;
    } else {
      break;
    }
  }
  return place;
}

size_t TextLayout::behind_comment(size_t place) const {
  const size_t comment = after_blanks(place);
  return text_.substr(comment).starts_with("//") ? line_end(comment) : place;
}

size_t TextLayout::after_blanks(size_t place) const {
  while (is_gap(at(place))) ++place;
  return place;
}

size_t TextLayout::before_blanks(size_t place) const {
  while (place > 0 && is_gap(text_[place - 1])) --place;
  return place;
}

size_t TextLayout::behind_first_comments() const {
  size_t line = 0;
  for (;;) {
    const std::string_view rest = text_.substr(after_blanks(line));
    if (!rest.starts_with("//") || rest.starts_with("///")) return line;
    line = next_line(line);
  }
}

size_t TextLayout::above_comments(size_t place) const {
  const size_t own = line_begin(place);
  size_t line = own;
  while (line > 0) {
    size_t before = line - 1;
    if (before > 0 && text_[before] == '\n' && text_[before - 1] == '\r') --before;
    before = line_begin(before);
    if (!text_.substr(after_blanks(before)).starts_with("//")) return line;
    line = before;
  }
  return own;
}

// True if a string that begins after `from` goes on at the beginning of a line.
bool TextLayout::begins_in_string(size_t from, size_t line) const {
  bool is_in_string = false;
  while (from < line) {
    if (is_in_string) {
      if (text_[from] == '\\')
        ++from;
      else if (text_[from] == '"')
        is_in_string = false;
      ++from;
    } else if (const size_t next = skip_blank(from); next != from) {
      from = next;
    } else {
      is_in_string = text_[from++] == '"';
    }
  }
  return is_in_string;
}

Replacements TextLayout::reindent(size_t from, size_t to, const std::string& old_indent,
                                  const std::string& new_indent) const {
  Replacements result;
  if (old_indent == new_indent) return result;
  for (size_t line = next_line(from); line < to && line > from; line = next_line(line)) {
    const bool is_empty = is_last_on_line(line);
    if (!is_empty && text_.substr(line).starts_with(old_indent) && !begins_in_string(from, line))
      result.push_back({line, line + old_indent.size(), new_indent});
    if (line_end(line) == text_.size()) break;
  }
  return result;
}

}  // namespace ombre::lang
