// Reduces the facets in each plane to as few as its outline needs.
#pragma once

#include "surface/cells/workers.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Removes vertices inside planes, and inside straight lines where planes meet, by collapsing edges (Hoppe et al. 1993).
// All removed vertices lie within most_mm of the planes that remain, however many are removed. The borders of regions
// are kept: lines where more than two regions meet are treated like other straight lines. Throws Cancelled.
void join_coplanar(RegionSurface& surface, double most_mm, const Workers& workers);

}  // namespace ombre::surface
