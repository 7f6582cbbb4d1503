// The borders of what is inside of polygons that may overlap and cross.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "import/fields/polygon_crossings.h"
#include "import/fields/segment_tree.h"

namespace ombre::importing {

// Pieces of edges with the inside on one side alone, at z = 0. They need not join to the last bit.
std::vector<LineSegment> polygon_walls(const Polygons& polygons, const PolygonCrossings& crossings);

// Two edges of a ring that cross, by the numbers of their first points; touching is not crossing.
std::optional<std::array<size_t, 2>> find_self_crossing(const Ring& ring);

}  // namespace ombre::importing
