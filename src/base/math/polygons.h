// Regions of a plane that polygons bound; mm.
#pragma once

#include <vector>

#include "base/math/vec.h"

namespace ombre {

// Its last point is joined to its first.
using Ring = std::vector<Vec2>;

// Inside is where the winding number of `solid` is not 0, and that of `holes` is.
struct Polygons {
  std::vector<Ring> solid, holes;
};

// Twice the area that the ring goes round, negative where it goes clockwise.
inline double doubled_area(const Ring& ring) {
  double sum = 0;
  for (size_t n = 0; n < ring.size(); ++n) {
    const Vec2 from = ring[n] - ring[0], to = ring[(n + 1) % ring.size()] - ring[0];
    sum += cross(from, to);
  }
  return sum;
}

}  // namespace ombre
