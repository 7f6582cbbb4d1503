// Strings as sequences of Unicode code points, in UTF-8.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ombre {

// Returns the number of bytes of the code point at `at`, or 0 if it is not valid UTF-8.
size_t code_point_size(std::string_view text, size_t at);
// Returns the number of bytes of the character at `at`; in text that is not valid UTF-8, as many as its first byte
// announces and the text has.
size_t character_size(std::string_view text, size_t at);
// Returns the code point at `at`, which must be valid.
uint32_t code_point(std::string_view text, size_t at);
// Appends a code point as UTF-8. Does nothing if `code` is not a Unicode scalar value.
void append_code_point(std::string& text, uint32_t code);
bool is_code_point(double code);
size_t count_code_points(std::string_view text);

}  // namespace ombre
