// Converts the borders of regions to triangles by dual contouring.
#pragma once

#include "base/system/progress.h"
#include "surface/cells/grid_borders.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Memory that contouring needs for each cell that a border passes through, measured with 2e5 to 3e6 cells.
constexpr double bytes_per_mixed_cell = 850;

// Returns the borders of the regions by dual contouring (Ju et al., 2002), with a vertex for each part of a cell
// (Nielson, 2004) and cells joined in an octree (Schaefer et al., 2007). Cells are subdivided up to grid_level times
// where samples show that the surface is too far off, or where a finer grid finds borders that the cells miss.
// Subdivision stops after some millions of additional cells.
// Where more than two regions meet, they share vertices. Features thinner than a quarter of a cell may be lost; the
// report says where. Throws Cancelled.
// What is known of the grid's borders, all of them, is not found again; null: nothing is.
RegionSurface contour(const Partition& partition, const ContourOptions& options, Progress* progress = nullptr,
                      const GridBorders* known = nullptr);

}  // namespace ombre::surface
