// Facets that go through each other.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "surface/contour.h"

namespace ombre::surface {

// Pairs of facets of which a side of one pierces the other, or that have a common side and lie upon each other, lower
// number first, in order. Facets that only touch do not count.
std::vector<std::pair<uint32_t, uint32_t>> find_intersections(const std::vector<Vec3>& vertices,
                                                              const std::vector<Facet>& facets, int threads);

}  // namespace ombre::surface
