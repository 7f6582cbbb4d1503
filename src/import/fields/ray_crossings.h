// Crossings of triangles with planes and rows, computed so that closed meshes stay exactly closed.
//
// A point of a mesh counts as infinitesimally before its position on all three axes: a vertex is above a plane z = k if
// its z > k, and so on. So no vertex, edge or face ever lies on a plane or a row, and meshes that share a face divide
// the points on it between them.
//
// Every crossing is computed from the two ends of an edge, the lower one first. Triangles that share an edge therefore
// get identical results, the outlines in a plane close exactly, and the crossings of a row add up to zero.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "base/math/vec.h"

namespace ombre::importing {

struct PlanePoint {
  double x = 0, y = 0;
};

// A segment of the outline in a plane z = k; the inside lies on its left.
struct Segment {
  PlanePoint from, to;
};

// Returns the crossing of an edge with a plane; `lower` is not above z = k, `upper` is.
inline PlanePoint cross_plane(const Vec3& lower, const Vec3& upper, double k) {
  const double t = (k - lower.z) / (upper.z - lower.z);
  return {lower.x + t * (upper.x - lower.x), lower.y + t * (upper.y - lower.y)};
}

// Returns the segment in which a triangle crosses the plane, or null if it does not.
inline std::optional<Segment> slice(const std::array<Vec3, 3>& corners, double k) {
  const std::array<bool, 3> above{corners[0].z > k, corners[1].z > k, corners[2].z > k};
  if (above[0] == above[1] && above[1] == above[2]) return std::nullopt;
  Segment segment;
  for (size_t i = 0; i < 3; ++i) {
    const size_t next = i == 2 ? 0 : i + 1;
    if (above[i] && !above[next]) segment.from = cross_plane(corners[next], corners[i], k);
    if (!above[i] && above[next]) segment.to = cross_plane(corners[i], corners[next], k);
  }
  return segment;
}

// Returns +1 if a row along +x enters through this segment, -1 if it leaves, 0 if it misses it.
inline int winding(const Segment& segment, double j) {
  return static_cast<int>(segment.from.y > j) - static_cast<int>(segment.to.y > j);
}

// Returns the x at which the row y = j crosses a segment that it does not miss.
inline double cross_row(const Segment& segment, double j) {
  const bool rises = segment.to.y > j;
  const PlanePoint& lower = rises ? segment.from : segment.to;
  const PlanePoint& upper = rises ? segment.to : segment.from;
  const double t = (j - lower.y) / (upper.y - lower.y);
  return lower.x + t * (upper.x - lower.x);
}

}  // namespace ombre::importing
