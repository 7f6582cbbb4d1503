// Texts that messages can point into: scripts, design files, expressions.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ombre {

// Lines end at "\n", "\r\n", or "\r" alone.
inline constexpr std::string_view line_ends = "\n\r";
inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }

struct Place {
  int line = 1, column = 1;  // columns count Unicode code points, tabs as one
};

class SourceText {
 public:
  SourceText(std::string name, std::string text);

  const std::string& name() const { return name_; }  // as the user wrote the path
  std::string_view text() const { return text_; }
  Place place(size_t offset) const;
  std::string_view line(int number) const;  // without its line end; empty past the end

 private:
  size_t characters_before(size_t offset) const;

  std::string name_, text_;
  std::vector<size_t> line_starts_;
  std::vector<size_t> characters_before_block_;  // so that places in very long lines are found quickly
};

using SourcePtr = std::shared_ptr<const SourceText>;

inline SourcePtr make_source(std::string name, std::string text) {
  return std::make_shared<const SourceText>(std::move(name), std::move(text));
}

// Bytes [begin, end) of a source; no source means "nowhere in particular", an empty range at its
// beginning the source as a whole.
struct SourceRange {
  SourcePtr source;
  uint32_t begin = 0, end = 0;

  // A part of this range, counted from its beginning.
  SourceRange part(size_t from, size_t to) const {
    return {source, static_cast<uint32_t>(begin + from), static_cast<uint32_t>(begin + to)};
  }
  bool operator==(const SourceRange&) const = default;
};

}  // namespace ombre
