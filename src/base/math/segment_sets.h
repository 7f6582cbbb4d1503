// Sets of line segments that share ends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/math/point_sets.h"

namespace ombre {

// Returns a number for each end, 2 n and 2 n + 1 for segment n, which ends at the same place share: those at most
// `tolerance` apart. Segments repeat along the axes where `period` is above 0, and ends with them.
std::vector<uint32_t> places_of_ends(std::span<const Edge3> segments, double tolerance, Vec3 period = {});

// Returns the segments with those joined to one that share an end and go on straight, and without segments that have no
// length or are there twice. Ends at most `tolerance` apart count as one. The order is that of the first segments.
std::vector<Edge3> joined_in_line(std::span<const Edge3> segments, double tolerance);

// Returns a number of segments that are within `distance` of a point at once, or more: the greatest number of segments
// whose boxes are at most twice as far from that of one of them.
size_t most_within(std::span<const Edge3> segments, double distance);

}  // namespace ombre
