// Closes the gaps of a surface, so that winding numbers become whole.
#pragma once

#include <vector>

#include "import/surfaces/surface.h"

namespace ombre::importing {

// A fan of triangles between an apex and the edges of a closed rim: (apex, rim[i], rim[i + 1]).
struct Cap {
  Vec3 apex;
  std::vector<Vec3> rim;  // at least three corners

  std::array<Vec3, 3> corners(size_t i) const { return {apex, rim[i], rim[i + 1 == rim.size() ? 0 : i + 1]}; }
};

struct CappedSurface {
  SurfacePtr closed;      // the surface's triangles, slivers along its cracks, and the caps' triangles
  std::vector<Cap> caps;  // one for each loop of edges that stays open
};

// Closes a surface. Corners of open edges that are nearer to each other than 1e-4 of the surface's size count as the
// two sides of a crack; vertices at exactly the same place count as one. Any triangles are allowed, including none and
// ones without neighbours.
CappedSurface close_by_caps(const Surface& surface);

}  // namespace ombre::importing
