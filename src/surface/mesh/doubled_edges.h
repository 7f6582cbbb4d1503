// Separates the sheets of a surface that touch in an edge.
#pragma once

#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Cuts each edge that has more than two facets between the same two regions at its middle. Two sheets may share both
// ends of such an edge and stay connected around the ends; then only vertices on the edge can separate them. Pairs of
// facets with the same corners that face opposite ways are removed first.
void cut_doubled_edges(RegionSurface& surface);

}  // namespace ombre::surface
