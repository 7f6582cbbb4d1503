// Which chains of a layer run across each other.
#pragma once

#include <utility>
#include <vector>

#include "surface/outline/outline_chains.h"

namespace ombre::surface {

// From node a to node b of a chain.
struct ChainSegment {
  uint32_t chain = 0, a = 0, b = 0;
};

// Pairs of segments that cross, or lie on each other for some length. What only touches does not.
std::vector<std::pair<ChainSegment, ChainSegment>> find_overlaps(const OutlineGraph& graph,
                                                                 const std::vector<OutlineChain>& chains);

}  // namespace ombre::surface
