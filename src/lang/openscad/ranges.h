// Numbers of elements of ranges, as OpenSCAD counts them.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

// Loops over ranges with this many elements or more are not executed.
inline constexpr double most_range_elements = 1'000'000;
// The number of elements of an endless range.
inline constexpr double endless = 4'294'967'295;

inline double element_count(const Range& range) {
  if (std::isnan(range.begin) || std::isnan(range.step) || std::isnan(range.end)) return 0;
  if (range.step < 0 ? range.begin < range.end : range.begin > range.end) return 0;
  if (range.begin == range.end || std::isinf(range.step)) return 1;
  if (std::isinf(range.begin) || std::isinf(range.end) || range.step == 0) return endless;
  const double count = range.count();
  return count > endless ? endless : count;
}

// Returns the numbers by which ranges compare: empty ranges are equal, and less than others.
inline std::array<double, 3> order_key(const Range& range) {
  const double count = element_count(range);
  if (count == 0) return {-std::numeric_limits<double>::infinity(), 0, 0};
  return {range.begin, range.step, count};
}

}  // namespace ombre::lang::openscad
