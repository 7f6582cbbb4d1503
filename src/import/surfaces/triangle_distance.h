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

}  // namespace ombre::importing
