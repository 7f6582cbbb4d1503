// Derivatives of what nodes compute at points.
#pragma once

#include <array>

#include "program/gradient.h"

namespace ombre::nodes {

using Slope = std::array<program::Field, 3>;  // derivatives by x, y and z, per mm

inline bool is_zero(program::Field field) { return field.builder->constant_value(field) == 0.0; }

// Returns the derivatives of `of(p)`, by differences if there is no symbolic derivative.
template <class Of>
Slope slope_at(const Of& of, const program::Point& p) {
  if (const auto by_rule = program::gradient(of(p), p)) return *by_rule;
  constexpr double step = 1e-2;  // step of differences in mm
  Slope result;
  for (int n = 0; n < 3; ++n) {
    Vec3 by;
    by[n] = step;
    const program::Field up = of(p.mapped(Affine::translation(by)));
    const program::Field down = of(p.mapped(Affine::translation(-by)));
    result[static_cast<size_t>(n)] = (up - down) / (2 * step);
  }
  return result;
}

// Arithmetic that leaves out what is always 0. Products with 0 are not left out elsewhere, since infinity times 0 is
// NaN.
inline program::Field sum_without_zeros(program::Field a, program::Field b) {
  return is_zero(a) ? b : is_zero(b) ? a : a + b;
}
inline program::Field product_without_zeros(program::Field a, program::Field b) {
  return is_zero(a) ? a : is_zero(b) ? b : a * b;
}
inline program::Field dot_without_zeros(const Slope& a, const Slope& b) {
  program::Field sum = a[0].builder->constant(0);
  for (size_t n = 0; n < 3; ++n) sum = sum_without_zeros(sum, product_without_zeros(a[n], b[n]));
  return sum;
}
inline Slope cross_without_zeros(const Slope& a, const Slope& b) {
  const auto part = [&](size_t i, size_t j) {
    const program::Field back = product_without_zeros(a[j], b[i]);
    const program::Field forth = product_without_zeros(a[i], b[j]);
    return is_zero(back) ? forth : is_zero(forth) ? -back : forth - back;
  };
  return {part(1, 2), part(2, 0), part(0, 1)};
}

}  // namespace ombre::nodes
