// Number of edges of circles, and functions of angles in degrees.
#pragma once

#include "base/math/vec.h"
#include "solids/tree.h"

namespace ombre::solids {

// Returns the number of edges of a full circle of this radius, at least 3, by the rules of OpenSCAD's manual: `count`
// if it is given; otherwise the least number that `angle` or `size` allow, at least 5.
int edges_of_circle(double radius_mm, const Fragments& fragments);

// sine() and cosine() are exact at multiples of 30 degrees if the value is rational.
double sine(double degrees);
double cosine(double degrees);

// Returns the point of a circle at this angle from the x axis.
inline Vec2 on_circle(double radius_mm, double degrees) {
  return {radius_mm * cosine(degrees), radius_mm * sine(degrees)};
}

// Limit on the number of edges, more than any machine prints; greater requests are reduced to it.
inline constexpr int most_edges = 1 << 20;

}  // namespace ombre::solids
