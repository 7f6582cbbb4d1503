// The boundary of the union of polygons, which may overlap and cross.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "import/fields/polygon_crossings.h"
#include "import/fields/segment_tree.h"

namespace ombre::importing {

// Returns the pieces of edges at z = 0 that have the inside on one side only. Their ends may differ by rounding.
std::vector<LineSegment> polygon_walls(const Polygons& polygons, const PolygonCrossings& crossings);

// Returns the first points' numbers of two edges of a ring that cross, or null. Touching edges do not count.
std::optional<std::array<size_t, 2>> find_self_crossing(const Ring& ring);

}  // namespace ombre::importing
