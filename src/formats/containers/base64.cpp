#include "formats/containers/base64.h"

#include <array>
#include <cstdint>

namespace ombre::formats {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int8_t, 256> digit_values() {
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
  uint32_t group = 0, count = 0, ends = 0;
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const int8_t value = c == '=' ? int8_t{0} : values[static_cast<unsigned char>(c)];
    if (value < 0 || (c != '=' && ends > 0)) return std::nullopt;
    if (c == '=') ++ends;
    group = group << 6 | static_cast<uint32_t>(value);
    if (++count < 4) continue;
    if (ends > 2) return std::nullopt;
    for (uint32_t n = 0; n < 3 - ends; ++n) bytes += static_cast<char>(group >> (16 - 8 * n) & 0xFF);
    group = count = ends = 0;
  }
  if (count > 0) return std::nullopt;
  return bytes;
}

std::string to_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t n = 0; n < bytes.size(); n += 3) {
    const auto byte = [&](size_t i) {
      return n + i < bytes.size() ? uint32_t{static_cast<unsigned char>(bytes[n + i])} : 0;
    };
    const uint32_t group = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (size_t digit = 0; digit < 4; ++digit)
      text += n + digit > bytes.size() ? '=' : digits[group >> (18 - 6 * digit) & 63];
  }
  return text;
}

}  // namespace ombre::formats
