// Paths as field sources.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "program/field_source.h"

namespace ombre::importing {

// The straight lines from each of two points or more to the next. Channels "distance": mm to their nearest place; and
// "along": the length of the path up to there as a share of all of it, 0 to 1.
program::SourceField make_path_source(const std::vector<Vec3>& points);
// One point or more. Channels "distance": mm to the nearest; and "index": its number in the list, the first of equally
// near ones.
program::SourceField make_points_source(const std::vector<Vec3>& points);

}  // namespace ombre::importing
