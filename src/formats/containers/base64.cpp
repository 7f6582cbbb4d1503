#include "formats/containers/base64.h"

#include <array>
#include <cstdint>

namespace ombre::formats {
namespace {

constexpr std::array<int8_t, 256> digit_values() {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int8_t, 256> values{};
  for (int8_t& value : values) value = -1;
  for (size_t n = 0; n < digits.size(); ++n) values[static_cast<unsigned char>(digits[n])] = static_cast<int8_t>(n);
  return values;
}

}  // namespace

std::optional<std::string> from_base64(std::string_view text) {
  static constexpr auto values = digit_values();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  uint32_t group = 0, digits = 0, ends = 0;
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const int8_t value = c == '=' ? int8_t{0} : values[static_cast<unsigned char>(c)];
    if (value < 0 || (c != '=' && ends > 0)) return std::nullopt;
    if (c == '=') ++ends;
    group = group << 6 | static_cast<uint32_t>(value);
    if (++digits < 4) continue;
    if (ends > 2) return std::nullopt;
    for (uint32_t n = 0; n < 3 - ends; ++n) bytes += static_cast<char>(group >> (16 - 8 * n) & 0xFF);
    group = digits = ends = 0;
  }
  if (digits > 0) return std::nullopt;
  return bytes;
}

}  // namespace ombre::formats
