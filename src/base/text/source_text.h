// Source texts that messages refer to: scripts, design files, expressions.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ombre {

// Lines end with "\n", "\r\n" or "\r".
inline constexpr std::string_view line_ends = "\n\r";
inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }

struct Place {
  int line = 1, column = 1;  // columns count Unicode code points; a tab counts as one
};

class SourceText {
 public:
  SourceText(std::string name, std::string text);

  const std::string& name() const { return name_; }  // path as the user wrote it
  std::string_view text() const { return text_; }
  Place place(size_t offset) const;
  std::string_view line(int number) const;  // a line without its line ending; empty beyond the last line

 private:
  size_t characters_before(size_t offset) const;

  std::string name_, text_;
  std::vector<size_t> line_starts_;
  std::vector<size_t> characters_before_block_;  // makes finding positions in very long lines fast
};

using SourcePtr = std::shared_ptr<const SourceText>;

inline SourcePtr make_source(std::string name, std::string text) {
  return std::make_shared<const SourceText>(std::move(name), std::move(text));
}

// Bytes [begin, end) of a source. No source means no known position; an empty range at the beginning means the whole
// source.
struct SourceRange {
  SourcePtr source;
  uint32_t begin = 0, end = 0;

  // Returns a part of this range; offsets count from its beginning.
  SourceRange part(size_t from, size_t to) const {
    return {source, static_cast<uint32_t>(begin + from), static_cast<uint32_t>(begin + to)};
  }
  bool operator==(const SourceRange&) const = default;
};

}  // namespace ombre
