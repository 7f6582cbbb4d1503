// Finds thin walls of a solid by counting the bricks across them.
#pragma once

#include <cstdint>
#include <vector>

#include "fea/model/bricks.h"

namespace ombre::fea {

inline constexpr double few_bricks = 3;

// Returns 1 for bricks in a wall of fewer than `few_bricks`: along some axis, the filled length from one surface to the
// other, counted in bricks, is less.
std::vector<uint8_t> bricks_of_thin_walls(const Bricks& bricks);

// Returns the share of the volume that lies in such walls.
double share_of_thin_walls(const Bricks& bricks);

}  // namespace ombre::fea
