// Borders that no corner of a grid's cells shows, such as those of small pockets and thin gaps.
#pragma once

#include <functional>
#include <vector>

#include "base/system/progress.h"
#include "surface/cells/crossed_edges.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// Finds crossed edges of finer cells (a quarter of the grid's) inside cells of the grid that the tree does not have;
// nothing in the tree may be subdivided yet. Calls take() with batches of edges, in an order independent of the number
// of threads, until it returns false. The edges' leaves are not set. Finds nothing if cells are smaller than about
// 1e-14 mm, because a quarter of that is no Pitch. Throws Cancelled.
void find_hidden_edges(const program::Program& label, const CellTree& tree, int threads, const StopFlag* stop,
                       const std::function<bool(const std::vector<CrossedEdge>&)>& take);

}  // namespace ombre::surface
