// Simplifies chains to as few points as a tolerance allows.
#pragma once

#include "surface/outline/outline_chains.h"
#include "voxel/lattice.h"

namespace ombre::surface {

// Returns the chains of a graph. Vertices whose chains cross another move onto their cells; if that is not enough, they
// move to the means of their crossings, where no chains cross.
std::vector<OutlineChain> untangle(const voxel::Lattice& corners, OutlineGraph& graph);

// Returns the chains with fewer points; no removed point is farther than the tolerance from its chain. Ends of chains
// stay, so junctions stay connected, and no new crossings arise. Chains that would collapse keep more of their points.
std::vector<OutlineChain> simplify(const OutlineGraph& graph, const std::vector<OutlineChain>& chains,
                                   double tolerance_mm);

}  // namespace ombre::surface
