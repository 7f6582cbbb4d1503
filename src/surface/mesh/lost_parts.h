// Finds parts and gaps of a design that are too thin to contain a corner of the cells.
#pragma once

#include "base/system/progress.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Searches from each corner that has no facet near it, along the gradient of g, for a border closer than a cell. If the
// other side of that border is a different region, the surface misses a part or a gap. g must approximate a distance;
// grids of more than 2^29 cells are not searched. Results do not depend on the number of threads. Throws Cancelled.
LostParts find_lost_parts(const Partition& partition, const RegionSurface& surface, const voxel::Lattice& corners,
                          int threads, const StopFlag* stop = nullptr);

}  // namespace ombre::surface
