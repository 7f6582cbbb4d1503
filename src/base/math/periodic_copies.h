// Copies of boxes and points that repeat along axes.
#pragma once

#include <array>
#include <cmath>

#include "base/math/box.h"
#include "base/math/interval.h"

namespace ombre {

// Returns the copy of a point in the first period. It repeats along the axes where `period` is above 0.
inline Vec3 within_period(Vec3 p, Vec3 period) {
  for (int axis = 0; axis < 3; ++axis)
    if (period[axis] > 0) p[axis] -= period[axis] * std::floor(p[axis] / period[axis]);
  return p;
}

// Calls visit(by) for each multiple of the period by which a box may be moved so that it meets another.
template <class Visit>
void each_copy_that_meets(const Box& box, const Box& other, Vec3 period, const Visit& visit) {
  std::array<Interval, 3> steps;
  for (int axis = 0; axis < 3; ++axis) {
    if (period[axis] <= 0) continue;
    steps[static_cast<size_t>(axis)] = {std::ceil((other.lo[axis] - box.hi[axis]) / period[axis]),
                                        std::floor((other.hi[axis] - box.lo[axis]) / period[axis])};
  }
  for (double k = steps[2].lo; k <= steps[2].hi; ++k)
    for (double j = steps[1].lo; j <= steps[1].hi; ++j)
      for (double i = steps[0].lo; i <= steps[0].hi; ++i) visit(Vec3{i * period.x, j * period.y, k * period.z});
}

}  // namespace ombre
