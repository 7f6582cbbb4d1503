// Approximates arcs of ellipses by chords.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math/math.h"
#include "base/math/polygons.h"

namespace ombre::formats {

// An arc whose points are center + cos(t) * first + sin(t) * second.
struct EllipseArc {
  Vec2 center, first, second;
  double begin = 0, turn = 2 * std::numbers::pi;  // radians

  Vec2 at(double t) const { return center + math::cos(t) * first + math::sin(t) * second; }
};

// Appends points from the beginning of the arc to its end, both included.
inline void append_arc(const EllipseArc& arc, int chords_per_turn, Ring& ring) {
  const double share = std::abs(arc.turn) / (2 * std::numbers::pi);
  const int chords = std::max(1, static_cast<int>(std::ceil(share * chords_per_turn - 1e-9)));
  for (int n = 0; n <= chords; ++n) ring.push_back(arc.at(arc.begin + arc.turn * n / chords));
}

}  // namespace ombre::formats
