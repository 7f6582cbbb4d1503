// Finds chains of a layer that cross each other.
#pragma once

#include <utility>
#include <vector>

#include "surface/outline/outline_chains.h"

namespace ombre::surface {

// The segment of a chain from node a to node b.
struct ChainSegment {
  uint32_t chain = 0, a = 0, b = 0;
};

// Returns the pairs of segments that cross, or overlap along some length. Pairs that only touch do not count.
std::vector<std::pair<ChainSegment, ChainSegment>> find_overlaps(const OutlineGraph& graph,
                                                                 const std::vector<OutlineChain>& chains);

}  // namespace ombre::surface
