// Facets that lie in one plane, as few as its outline needs.
#pragma once

#include "surface/cells/workers.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Removes vertices within planes, and within straight lines where planes meet, by collapsing edges (Hoppe et al. 1993).
// What was there lies within most_mm of the planes that stay, however many vertices go. Regions keep their borders:
// lines where more than two meet are straight lines like any other. Throws Cancelled.
void join_coplanar(RegionSurface& surface, double most_mm, const Workers& workers);

}  // namespace ombre::surface
