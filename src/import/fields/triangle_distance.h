// Distances from points to triangles.
#pragma once

#include <algorithm>
#include <array>

#include "base/math/vec.h"

namespace ombre::importing {

inline double squared_distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double squared = dot(along, along);
  const double t = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0;
  const Vec3 offset = p - (a + t * along);
  return dot(offset, offset);
}

// Returns the squared distance in mm2. Triangles without area count as segments or points.
inline double squared_distance(Vec3 p, const std::array<Vec3, 3>& t) {
  const double to_edges =
      std::min({squared_distance_to_segment(p, t[0], t[1]), squared_distance_to_segment(p, t[1], t[2]),
                squared_distance_to_segment(p, t[2], t[0])});
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double squared = dot(normal, normal);
  if (!(squared > 0)) return to_edges;
  // The nearest point is in the plane of the triangle if p projects into the triangle.
  for (size_t i = 0; i < 3; ++i)
    if (dot(cross(t[i == 2 ? 0 : i + 1] - t[i], p - t[i]), normal) < 0) return to_edges;
  const double height = dot(normal, p - t[0]);
  return std::min(to_edges, height * height / squared);
}

// Returns the barycentric coordinates of the point of a triangle nearest to p. Source: C. Ericson, Real-Time Collision
// Detection, 2005, 5.1.5.
inline std::array<double, 3> nearest_shares(const std::array<Vec3, 3>& t, Vec3 p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const auto edge = [](double from, double to) { return from - to > 0 ? from / (from - to) : 0.0; };
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - edge(d1, d3), edge(d1, d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - edge(d2, d6), 0, edge(d2, d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) return {0, 1 - edge(d4 - d3, d6 - d5), edge(d4 - d3, d6 - d5)};
  const double sum = va + vb + vc;
  if (!(sum > 0)) return {1, 0, 0};
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace ombre::importing
