// Number of edges of circles, and their points.
#pragma once

#include "base/math/degrees.h"
#include "base/math/vec.h"
#include "solids/tree.h"

namespace ombre::solids {

// Returns the number of edges of a full circle of this radius, at least 3, by the rules of OpenSCAD's manual: `count`
// if it is given; otherwise the least number that `angle` or `size` allow, at least 5.
int edges_of_circle(double radius_mm, const Fragments& fragments);

// Returns the point of a circle at this angle from the x axis.
inline Vec2 on_circle(double radius_mm, double angle) {
  return {radius_mm * degrees::cosine(angle), radius_mm * degrees::sine(angle)};
}

// Limit on the number of edges, more than any machine prints; greater requests are reduced to it.
inline constexpr int most_edges = 1 << 20;

}  // namespace ombre::solids
