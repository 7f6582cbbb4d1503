#include "base/text/source_text.h"

#include <algorithm>

namespace ombre {
namespace {

constexpr size_t block = 1024;

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

}  // namespace

SourceText::SourceText(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
  line_starts_.push_back(0);
  size_t characters = 0;
  for (size_t i = 0; i < text_.size(); ++i) {
    if (i % block == 0) characters_before_block_.push_back(characters);
    characters += begins_character(text_[i]);
    const bool is_half_end = text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
    if (is_line_end(text_[i]) && !is_half_end) line_starts_.push_back(i + 1);
  }
  // The last entry serves positions at the end of a text that consists of whole blocks.
  characters_before_block_.push_back(characters);
}

size_t SourceText::characters_before(size_t offset) const {
  size_t count = characters_before_block_[offset / block];
  for (size_t i = offset / block * block; i < offset; ++i) count += begins_character(text_[i]);
  return count;
}

Place SourceText::place(size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const size_t start = *(next - 1);
  return {static_cast<int>(next - line_starts_.begin()),
          static_cast<int>(1 + characters_before(offset) - characters_before(start))};
}

std::string_view SourceText::line(int number) const {
  if (number < 1 || static_cast<size_t>(number) > line_starts_.size()) return {};
  const size_t start = line_starts_[number - 1];
  const size_t end = std::min(text_.find_first_of(line_ends, start), text_.size());
  return std::string_view(text_).substr(start, end - start);
}

}  // namespace ombre
