// Regions of a plane that are bounded by polygons; lengths in mm.
#pragma once

#include <vector>

#include "base/math/vec.h"

namespace ombre {

// A closed polygon: its last point is joined to its first.
using Ring = std::vector<Vec2>;

// A region of the plane: the points where the winding number of `solid` is not 0 and that of `holes` is 0.
struct Polygons {
  std::vector<Ring> solid, holes;
};

// Returns twice the signed area of the ring, negative if it is clockwise.
inline double doubled_area(const Ring& ring) {
  double sum = 0;
  for (size_t n = 0; n < ring.size(); ++n) {
    const Vec2 from = ring[n] - ring[0], to = ring[(n + 1) % ring.size()] - ring[0];
    sum += cross(from, to);
  }
  return sum;
}

}  // namespace ombre
