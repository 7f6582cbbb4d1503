// What can be wrong with the points of a query.
#pragma once

#include <span>
#include <string>

#include "base/vec.h"

namespace ombre {

inline constexpr size_t most_set_points = 100'000;

// For people; "" when nothing is.
std::string problem_of_points(std::span<const Vec3> points, size_t least, bool may_repeat);

}  // namespace ombre
