#include "base/text/utf8.h"

#include <algorithm>
#include <cmath>

namespace ombre {
namespace {

uint32_t byte(std::string_view text, size_t at) { return static_cast<unsigned char>(text[at]); }

bool is_scalar(uint32_t code) { return code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF); }

size_t announced_size(uint32_t lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

}  // namespace

size_t code_point_size(std::string_view text, size_t at) {
  const size_t size = announced_size(byte(text, at));
  if (size == 0 || at + size > text.size()) return 0;
  for (size_t i = 1; i < size; ++i)
    if ((byte(text, at + i) & 0xC0) != 0x80) return 0;
  const uint32_t code = code_point(text, at);
  const bool is_overlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  return is_overlong || !is_scalar(code) ? 0 : size;
}

size_t character_size(std::string_view text, size_t at) {
  const size_t size = code_point_size(text, at);
  return size > 0 ? size : std::clamp<size_t>(announced_size(byte(text, at)), 1, text.size() - at);
}

uint32_t code_point(std::string_view text, size_t at) {
  const uint32_t lead = byte(text, at);
  const size_t size = announced_size(lead);
  if (size <= 1) return lead;
  uint32_t code = lead & (0xFFu >> (size + 1));
  for (size_t i = 1; i < size && at + i < text.size(); ++i) code = (code << 6) | (byte(text, at + i) & 0x3F);
  return code;
}

void append_code_point(std::string& text, uint32_t code) {
  const auto put = [&](uint32_t b) { text += static_cast<char>(static_cast<unsigned char>(b)); };
  if (!is_scalar(code)) return;
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6));
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | (code >> 18));
    put(0x80 | ((code >> 12) & 0x3F));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

bool is_code_point(double code) {
  return code >= 1 && code <= 0x10FFFF && is_scalar(static_cast<uint32_t>(std::floor(code)));
}

size_t count_code_points(std::string_view text) {
  size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

}  // namespace ombre
