// Chains with as few points as a tolerance allows.
#pragma once

#include "surface/outline_chains.h"

namespace ombre::surface {

// Vertices that lead a chain across another go to the means of their crossings, where none does.
// Returns how many went there.
size_t untangle(OutlineGraph& graph, const std::vector<OutlineChain>& chains);

// Leaves points out, none farther than the tolerance from what stays. The ends of chains stay, so what meets there
// meets still; no chain crosses another that did not before. What would collapse keeps more of its points.
std::vector<OutlineChain> simplify(const OutlineGraph& graph, const std::vector<OutlineChain>& chains,
                                   double tolerance_mm);

}  // namespace ombre::surface
