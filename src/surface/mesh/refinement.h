// Cells that are cut because one vertex cannot say what the surface does in them.
#pragma once

#include <vector>

#include "surface/cells/partition.h"
#include "surface/mesh/dual_mesh.h"

namespace ombre::surface {

// Lets a tree grow, by what may be in any order and more than once, and cuts leaves in which hidden edges are until
// they show them; then those around them that are not mixed, though the surface goes into them, or far larger, as long
// as the tree has fewer than `most_leaves`. Throws Cancelled.
void refine(CellTree& tree, Growth first, const std::vector<CrossedEdge>& hidden, size_t most_leaves,
            const Partition& partition, int threads, const StopFlag* stop);

}  // namespace ombre::surface
