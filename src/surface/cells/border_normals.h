// Normals of the borders between regions where edges of cells cross them.
#pragma once

#include <span>
#include <vector>

#include "surface/cells/edge_search.h"

namespace ombre::surface {

// Returns for each finished search the border's unit normal at the crossing, from region `from` into `to`. It is the
// gradient of the value that separates the regions, by central differences. If that value jumps or does not exist, the
// slope of the border around the crossing is measured instead.
std::vector<Vec3> border_normals(std::span<const EdgeSearch> searches, const Vec3& cell_mm, PointEvaluator& evaluator);

// Distance from an edge within which border_normals() evaluates points, as a fraction of a cell.
constexpr double normals_reach = 0.25;

}  // namespace ombre::surface
