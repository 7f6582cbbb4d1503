// How the borders of regions go through one cell: which of its crossed edges belong together.
#pragma once

#include <array>
#include <cstdint>

#include "surface/cells/cell_grid.h"

namespace ombre::surface {

// Crossed edges that are joined across the cell's faces are one part. Where two regions meet, a part is one disc
// (Nielson, Dual Marching Cubes, 2004). Faces whose diagonals could both be joined join the greater label, and
// cells that share the face see it alike.
struct CellParts {
  static constexpr uint8_t none = 255;
  std::array<uint8_t, 12> part_of_edge{};  // none where the edge is not crossed
  uint8_t count = 0;
};

CellParts find_cell_parts(const std::array<Label, 8>& corners);

}  // namespace ombre::surface
