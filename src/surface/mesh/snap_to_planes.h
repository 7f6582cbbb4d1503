// Vertices that should lie in a plane, and nearly do.
#pragma once

#include "surface/cells/workers.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Finds planes in which most vertices lie within exact_mm, and moves what of their facets' vertices is off by more than
// rounding, and by no more than near_mm, into them: into the line or the point where several meet. Curved surfaces stay
// as they are. Throws Cancelled.
void snap_to_planes(RegionSurface& surface, double exact_mm, double near_mm, const Workers& workers);

}  // namespace ombre::surface
