// Conversion of cubic curves to chains of straight lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math/vec.h"

namespace ombre {

// A cubic Bézier curve with end points a and d and control points b and c.
template <class Vec>
struct Cubic {
  Vec a, b, c, d;

  Vec at(double t) const {
    const double s = 1 - t;
    return (s * s * s) * a + (3 * s * s * t) * b + (3 * s * t * t) * c + (t * t * t) * d;
  }
};

// Appends points of the curve after its start. No chord lies farther from the curve than `tolerance`: its distance is
// at most the squared step times the greatest second derivative, divided by 8.
template <class Vec>
void append_chords(const Cubic<Vec>& curve, double tolerance, std::vector<Vec>& points) {
  constexpr double most_steps = 1000;
  const Vec bend_first = curve.a - 2 * curve.b + curve.c, bend_last = curve.b - 2 * curve.c + curve.d;
  const double bend = 6 * std::max(length(bend_first), length(bend_last));
  const double steps = std::clamp(std::ceil(std::sqrt(bend / (8 * tolerance))), 1.0, most_steps);
  for (double n = 1; n < steps; ++n) points.push_back(curve.at(n / steps));
  points.push_back(curve.d);
}

}  // namespace ombre
