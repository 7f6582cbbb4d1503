// The edges of leaves whose ends lie in different regions, and the leaves around them.
#pragma once

#include <array>
#include <vector>

#include "base/system/progress.h"
#include "surface/cells/cell_tree.h"

namespace ombre::surface {

// No leaf around the edge is smaller than it is long.
struct CrossedEdge {
  CellPlace start{};  // in units
  uint8_t axis = 0, level = 0;
  Label from = 0, to = 0;  // regions at its ends
  // Corner n of an edge lies in the leaf where the edge has offsets quad_offsets[n]; larger leaves are there twice.
  std::array<uint32_t, 4> leaves{};
};
constexpr std::array<std::array<int, 2>, 4> quad_offsets{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

// The unit at an edge's start, in the leaf of this corner.
CellPlace unit_beside(const CrossedEdge& edge, size_t corner);

// One leaf around each edge lists it.
struct ListedEdge {
  uint32_t leaf = 0;
  CrossedEdge edge;
};

// The edges that all leaves list, or those near growth, in order of the leaves, then axes. Leaves around them are
// CellTree::none where the tree has no cell of the grid. Throws Cancelled.
std::vector<ListedEdge> crossed_edges(const CellTree& tree, bool only_near_growth, int threads,
                                      const StopFlag* stop = nullptr);
// Those of these leaves.
std::vector<ListedEdge> crossed_edges(const CellTree& tree, const std::vector<uint32_t>& leaves, int threads,
                                      const StopFlag* stop = nullptr);

}  // namespace ombre::surface
