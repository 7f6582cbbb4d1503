// Borders that no corner of a grid's cells shows, such as those of small pockets and thin gaps.
#pragma once

#include <functional>
#include <vector>

#include "base/system/progress.h"
#include "surface/cells/crossed_edges.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// Takes edges, and returns false if no more are wanted.
using TakeEdges = std::function<bool(const std::vector<CrossedEdge>&)>;

// Layers of cells whose hidden edges are found together.
inline constexpr int64_t strip_layers = 4;

// Finds crossed edges of finer cells (a quarter of the grid's) inside cells of the grid that the tree does not have;
// nothing in the tree may be subdivided yet. Calls take() with the edges of each strip of layers, also if there are
// none, in their order, until it returns false. `layers` begin with a strip, and end with one or with the grid. The
// edges' leaves are not set. Finds nothing if cells are smaller than about 1e-14 mm, because a quarter of that is no
// Pitch. Throws Cancelled.
void hidden_edges_in(CellLayers layers, const program::Program& label, const CellTree& tree, int threads,
                     const StopFlag* stop, const TakeEdges& take);

// Hands edges of strips on in batches, whose sizes depend on the edges alone.
class EdgeBatches {
 public:
  explicit EdgeBatches(const TakeEdges& take) : take_(take) {}
  // Returns false if no more are wanted.
  bool add(const std::vector<CrossedEdge>& edges);
  void finish();

 private:
  void hand_over();

  const TakeEdges& take_;
  std::vector<CrossedEdge> waiting_;
  bool goes_on_ = true;
};

// Finds those of all layers, and calls take() with batches of them.
void find_hidden_edges(const program::Program& label, const CellTree& tree, int threads, const StopFlag* stop,
                       const TakeEdges& take);

}  // namespace ombre::surface
