// The parts of the borders of regions within a leaf that touches smaller leaves.
#pragma once

#include <span>
#include <vector>

#include "surface/cells/crossings.h"

namespace ombre::surface {

// Returns a part number, from 0, for each crossing around a leaf; `around` holds the numbers of the crossings.
// Crossings that are joined across a face shared with a neighbour form one part, as in find_cell_parts: if two regions
// meet, each part is a ring, and both leaves at a face decide alike.
std::vector<uint32_t> find_leaf_parts(const CellTree& tree, const Leaf& leaf, const std::vector<Crossing>& crossings,
                                      std::span<const uint32_t> around);

}  // namespace ombre::surface
