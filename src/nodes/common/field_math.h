// Functions of fields for several families of values.
#pragma once

#include <array>

#include "design/outputs.h"
#include "program/field.h"

namespace ombre::nodes {

inline program::Field floor_of(program::Field v) { return v.builder->apply(program::Op::floor, v); }
inline program::Field limited(program::Field v, double least, double greatest) {
  return min(max(v, least), v.builder->constant(greatest));
}
inline program::Field to_degrees(program::Field radians) { return radians * (180 / 3.14159265358979323846); }
inline program::Field power_of(program::Field base, double exponent) {
  return power(base, base.builder->constant(exponent));
}
// Returns the remainder of division by a positive number, from 0 to that number.
inline program::Field wrapped(program::Field v, double period) { return v - floor_of(v / period) * period; }
inline program::Field dot_of(const std::array<program::Field, 3>& a, const std::array<program::Field, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
// Rises from 0 at t = 0 to 1 at t = 1, with slope 0 at both ends.
inline program::Field smooth_step(program::Field t) { return t * t * (3.0 - t * 2.0); }

}  // namespace ombre::nodes
