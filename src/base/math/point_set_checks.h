// Checks of points from which hulls, edges and tubes are made.
#pragma once

#include <span>
#include <string>

#include "base/math/vec.h"

namespace ombre {

// Returns what is wrong with the points, as text for a message, or "" if they can be used. There must be from `least`
// to `most` points, all finite, not all in one plane, and no two equal unless `may_repeat`.
std::string problem_of_points(std::span<const Vec3> points, size_t least, size_t most, bool may_repeat);

}  // namespace ombre
