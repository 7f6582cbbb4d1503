// How the borders of regions lie where edges cross them.
#pragma once

#include <span>
#include <vector>

#include "surface/cells/edge_search.h"

namespace ombre::surface {

// A unit vector for each finished search, from its region `from` into `to`: the gradient of the value that parts them,
// by central differences; where that jumps or there is none, the slope of the border around the crossing.
std::vector<Vec3> border_normals(std::span<const EdgeSearch> searches, const Vec3& cell_mm, PointEvaluator& evaluator);

// Normals ask points so far around an edge, in parts of a cell.
constexpr double normals_reach = 0.25;

}  // namespace ombre::surface
