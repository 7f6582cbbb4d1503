// The borders of regions as triangles, by dual contouring.
#pragma once

#include "base/system/progress.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// What contouring takes for each cell that a border runs through, measured from 2e5 to 3e6 cells.
constexpr double bytes_per_mixed_cell = 850;

// Dual contouring (Ju et al., 2002) with a vertex for each part of a cell (Nielson, 2004), and cells joined in an
// octree as Schaefer et al. (2007) do. Cells are cut up to grid_level times where the surface is too far off at
// samples, or where a look at finer cells finds borders that they do not see, until there are millions more.
// Regions of more than two meet in shared vertices. What is thinner than a quarter of a cell may be lost; the report
// says where. Throws Cancelled.
RegionSurface contour(const Partition& partition, const ContourOptions& options, Progress* progress = nullptr);

}  // namespace ombre::surface
