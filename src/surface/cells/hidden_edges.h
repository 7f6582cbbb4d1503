// Borders that no corner of a grid's cells sees, as of small pockets and thin gaps.
#pragma once

#include <functional>
#include <vector>

#include "base/system/progress.h"
#include "surface/cells/crossed_edges.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// Finds edges of finer cells, a quarter as long, that are crossed in cells of the grid that the tree, of which nothing
// is cut, does not have. Calls take() with some after the other, in an order that does not depend on the threads, until
// it returns false. No leaves are given. Finds none in cells of less than about 1e-14 mm, whose quarter is no Pitch.
// Throws Cancelled.
void find_hidden_edges(const program::Program& label, const CellTree& tree, int threads, const StopFlag* stop,
                       const std::function<bool(const std::vector<CrossedEdge>&)>& take);

}  // namespace ombre::surface
