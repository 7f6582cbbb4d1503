// Subdivides cells in which one vertex cannot represent the surface.
#pragma once

#include <vector>

#include "surface/cells/partition.h"
#include "surface/mesh/dual_mesh.h"

namespace ombre::surface {

// Grows a tree by `first`, whose entries may be unordered and repeated. Leaves that contain hidden edges are subdivided
// until those are edges of leaves. Then leaves around crossed edges that are not mixed or much too large are
// subdivided, as long as the tree has fewer than `most_leaves` leaves. Throws Cancelled.
void refine(CellTree& tree, Growth first, const std::vector<CrossedEdge>& hidden, size_t most_leaves,
            const Partition& partition, int threads, const StopFlag* stop);

}  // namespace ombre::surface
