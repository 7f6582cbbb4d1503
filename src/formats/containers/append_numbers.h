// Appends numbers to files as text and bytes, identically on all machines.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "base/math/vec.h"

namespace ombre::formats {

// Appends the shortest decimal that reads back to the same float; -0 is written as 0.
void append_float(std::string& text, double value);
// Appends a number with at most six decimals, so millimetres are exact to the nanometre.
void append_decimal(std::string& text, double value);
// Appends "x y z", or the coordinates with another character between them and in another form.
void append_point(std::string& text, Vec3 p, char between = ' ',
                  void append(std::string& text, double value) = append_float);
void append_count(std::string& text, uint64_t value);

// Appends a little-endian number.
void append_u32(std::string& bytes, uint32_t value);
inline void append_f32(std::string& bytes, double value) {
  append_u32(bytes, std::bit_cast<uint32_t>(static_cast<float>(value)));
}
inline void append_point_f32(std::string& bytes, Vec3 p) {
  append_f32(bytes, p.x);
  append_f32(bytes, p.y);
  append_f32(bytes, p.z);
}

}  // namespace ombre::formats
