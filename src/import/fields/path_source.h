// Paths as field sources.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "program/field_source.h"

namespace ombre::importing {

// Returns the polyline through at least two points. Channel "distance" is the distance in mm to its nearest point;
// "along" is the length of the path up to that point as a share of its total length, 0 to 1.
program::SourceField make_path_source(const std::vector<Vec3>& points);
// Returns a set of at least one point. Channel "distance" is the distance in mm to the nearest; "index" is its number
// in the list, the lowest of equally near ones.
program::SourceField make_points_source(const std::vector<Vec3>& points);
// Returns segments, each from an even point to the next one. Channel "distance" is that to the nearest segment.
program::SourceField make_segments_source(const std::vector<Vec3>& points);
// Returns such segments with fillets: where segments have distances d below `reach`, the channel "distance" is reach -
// sqrt(sum of (reach - d)^2), elsewhere that to the nearest segment (nodes/solids/blends.h).
program::SourceField make_filleted_source(const std::vector<Vec3>& points, double reach);
// Returns triangles, each of three points. Channel "distance" is that to the nearest triangle.
program::SourceField make_triangles_source(const std::vector<Vec3>& points);
// Returns the Voronoi cells of at least two points. Channel "distance" is that to the nearest wall between cells.
program::SourceField make_point_cells_source(const std::vector<Vec3>& points);

}  // namespace ombre::importing
