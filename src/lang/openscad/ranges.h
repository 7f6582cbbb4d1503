// Ranges as OpenSCAD counts them.
#pragma once

#include <cmath>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

// A range of so many elements is not gone through.
inline constexpr double most_range_elements = 1'000'000;
// The count of a range without end.
inline constexpr double endless = 4'294'967'295;

inline double element_count(const Range& range) {
  if (std::isnan(range.begin) || std::isnan(range.step) || std::isnan(range.end)) return 0;
  if (std::isinf(range.begin) || std::isinf(range.end)) return range.begin == range.end ? 1 : endless;
  if (range.step == 0) return range.begin == range.end ? 1 : endless;
  const double count = range.count();
  return count > endless ? endless : count;
}

}  // namespace ombre::lang::openscad
