#include "formats/containers/append_numbers.h"

#include <charconv>
#include <string_view>

namespace ombre::formats {

void append_float(std::string& text, double value) {
  char digits[32];
  const float single = static_cast<float>(value) + 0.0f;  // maps -0 to 0
  text.append(digits, std::to_chars(digits, digits + sizeof digits, single).ptr);
}

void append_decimal(std::string& text, double value) {
  char digits[352];
  std::string_view written(digits,
                           std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 6).ptr);
  written = written.substr(0, written.find_last_not_of('0') + 1);
  if (written.ends_with('.')) written.remove_suffix(1);
  text += written == "-0" ? "0" : written;
}

void append_point(std::string& text, Vec3 p, char between, void append(std::string& text, double value)) {
  append(text, p.x);
  text += between;
  append(text, p.y);
  text += between;
  append(text, p.z);
}

void append_count(std::string& text, uint64_t value) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_u32(std::string& bytes, uint32_t value) {
  for (const int shift : {0, 8, 16, 24}) bytes += static_cast<char>(value >> shift & 0xFF);
}

}  // namespace ombre::formats
