// How many bricks lie across the walls of a solid.
#pragma once

#include <cstdint>
#include <vector>

#include "fea/model/bricks.h"

namespace ombre::fea {

inline constexpr double few_bricks = 3;

// 1 for bricks that lie in a wall of fewer than `few_bricks`: along some axis, those from one surface to the other have
// less inside, counted in bricks.
std::vector<uint8_t> bricks_of_thin_walls(const Bricks& bricks);

// The share of the volume that lies in such walls.
double share_of_thin_walls(const Bricks& bricks);

}  // namespace ombre::fea
