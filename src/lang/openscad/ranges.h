// Numbers of elements of ranges, as OpenSCAD counts them.
#pragma once

#include <cmath>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

// Loops over ranges with this many elements or more are not executed.
inline constexpr double most_range_elements = 1'000'000;
// The number of elements of an endless range.
inline constexpr double endless = 4'294'967'295;

inline double element_count(const Range& range) {
  if (std::isnan(range.begin) || std::isnan(range.step) || std::isnan(range.end)) return 0;
  if (std::isinf(range.begin) || std::isinf(range.end)) return range.begin == range.end ? 1 : endless;
  if (range.step == 0) return range.begin == range.end ? 1 : endless;
  const double count = range.count();
  return count > endless ? endless : count;
}

}  // namespace ombre::lang::openscad
