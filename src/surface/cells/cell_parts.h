// The parts of the borders of regions within one cell: which of its crossed edges belong together.
#pragma once

#include <array>
#include <cstdint>

#include "surface/cells/cell_grid.h"

namespace ombre::surface {

// Crossed edges that are joined across the cell's faces form one part. If two regions meet, each part is a disc
// (Nielson, Dual Marching Cubes, 2004). On a face where both diagonals could be joined, the greater label is joined, so
// both cells at the face decide alike.
struct CellParts {
  static constexpr uint8_t none = 255;
  std::array<uint8_t, 12> part_of_edge{};  // none if the edge is not crossed
  uint8_t count = 0;
};

CellParts find_cell_parts(const std::array<Label, 8>& corners);

}  // namespace ombre::surface
