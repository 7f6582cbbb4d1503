// Strings as sequences of Unicode code points.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ombre {

// Bytes of the code point that begins at `at`; 0 when no valid one does.
size_t code_point_size(std::string_view text, size_t at);
// The code point at `at`, which must be valid.
uint32_t code_point(std::string_view text, size_t at);
// Nothing happens for what is no Unicode scalar value.
void append_code_point(std::string& text, uint32_t code);
bool is_code_point(double code);
size_t count_code_points(std::string_view text);

}  // namespace ombre
