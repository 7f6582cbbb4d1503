// Moves vertices into planes in which they nearly lie.
#pragma once

#include "surface/cells/workers.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Finds planes in which most vertices lie within exact_mm. Vertices of their facets that are off by more than rounding,
// and by at most near_mm, move into the plane, or into the line or point where several planes meet. Curved surfaces
// stay unchanged. Throws Cancelled.
void snap_to_planes(RegionSurface& surface, double exact_mm, double near_mm, const Workers& workers);

}  // namespace ombre::surface
