// Chains with as few points as a tolerance allows.
#pragma once

#include "surface/outline/outline_chains.h"
#include "voxel/lattice.h"

namespace ombre::surface {

// The chains of a graph. Vertices that lead a chain across another go back to their cells, and if that is not enough
// to the means of their crossings, where no chain crosses another.
std::vector<OutlineChain> untangle(const voxel::Lattice& corners, OutlineGraph& graph);

// Leaves points out, none farther than the tolerance from what stays. The ends of chains stay, so what meets there
// meets still; no chain crosses another that did not before. What would collapse keeps more of its points.
std::vector<OutlineChain> simplify(const OutlineGraph& graph, const std::vector<OutlineChain>& chains,
                                   double tolerance_mm);

}  // namespace ombre::surface
