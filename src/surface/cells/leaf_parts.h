// How the borders of regions go through a leaf that smaller ones touch.
#pragma once

#include <span>
#include <vector>

#include "surface/cells/crossings.h"

namespace ombre::surface {

// Part numbers, from 0, of crossings around a leaf, given by their numbers. Crossings that are joined across the faces
// that the leaf has in common with its neighbours are one part, as in find_cell_parts: where two regions meet, each
// part is a ring, and both leaves at a face see it alike.
std::vector<uint32_t> find_leaf_parts(const CellTree& tree, const Leaf& leaf, const std::vector<Crossing>& crossings,
                                      std::span<const uint32_t> around);

}  // namespace ombre::surface
