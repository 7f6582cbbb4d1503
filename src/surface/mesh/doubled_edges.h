// Edges in which a surface meets itself.
#pragma once

#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Cuts edges that have more than two facets between the same two regions in their middles. Two sheets may have both
// ends of such an edge in common, and hang together around them: then only vertices on the edge can tell the
// sheets apart. Pairs of facets upon each other, with the same corners but opposite ways, are left out first.
void cut_doubled_edges(RegionSurface& surface);

}  // namespace ombre::surface
