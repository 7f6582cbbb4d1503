// Into how many edges circles are cut, and angles in degrees.
#pragma once

#include "base/math/vec.h"
#include "solids/tree.h"

namespace ombre::solids {

// Edges of a full circle of this radius, at least 3, as OpenSCAD's manual has it: `count` if it is given, else as few
// as `angle` or `size` allow, and at least 5.
int edges_of_circle(double radius_mm, const Fragments& fragments);

// Exact at multiples of 30 degrees where the value is rational.
double sine(double degrees);
double cosine(double degrees);

// At this angle from the x axis.
inline Vec2 on_circle(double radius_mm, double degrees) {
  return {radius_mm * cosine(degrees), radius_mm * sine(degrees)};
}

// More edges than any machine prints; what is asked for beyond is cut off.
inline constexpr int most_edges = 1 << 20;

}  // namespace ombre::solids
