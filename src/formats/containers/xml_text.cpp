#include "formats/containers/xml_text.h"

#include <cstdint>

namespace ombre::formats {
namespace {

size_t sequence_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

// Returns the length of the first character of the text; 0 if XML cannot hold it.
size_t character_length(std::string_view text) {
  const size_t length = sequence_length(static_cast<unsigned char>(text[0]));
  if (length == 0 || length > text.size()) return 0;
  if (length == 1) {
    const char c = text[0];
    return static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n' ? 1 : 0;
  }
  uint32_t code = static_cast<unsigned char>(text[0]) & (0x7Fu >> length);
  for (size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte & 0x3Fu);
  }
  const uint32_t least[]{0, 0, 0x80, 0x800, 0x10000};
  const bool is_character = code >= least[length] && code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF) &&
                            code != 0xFFFE && code != 0xFFFF;
  return is_character ? length : 0;
}

void append_escaped(std::string& out, char c) {
  switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    case '\n':
      out += "&#10;";
      break;
    case '\t':
      out += "&#9;";
      break;
    default:
      out += c;
  }
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (; !text.empty();) {
    const size_t length = character_length(text);
    if (length > 1)
      out += text.substr(0, length);
    else
      append_escaped(out, length == 1 ? text[0] : '?');
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string xml_attribute(std::string_view name, std::string_view value) {
  return ' ' + std::string(name) + "=\"" + xml_escaped(value) + '"';
}

std::string hex_colour(std::span<const uint8_t> parts) {
  constexpr const char* digits = "0123456789ABCDEF";
  std::string text = "#";
  for (const uint8_t part : parts) {
    text += digits[part >> 4];
    text += digits[part & 15];
  }
  return text;
}

}  // namespace ombre::formats
