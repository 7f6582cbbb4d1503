// Parts and gaps of a design that are too thin for any corner of the cells to lie in.
#pragma once

#include "base/system/progress.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Searches from the corners that have no facet near, along the gradient of g for a border closer than a cell. Where
// space lies on its other side, a part or a gap is missing from the surface. g must be about a distance; grids of
// more than 2^29 cells are left out. Results do not depend on the number of threads. Throws Cancelled.
LostParts find_lost_parts(const Partition& partition, const RegionSurface& surface, const voxel::Lattice& corners,
                          int threads, const StopFlag* stop = nullptr);

}  // namespace ombre::surface
