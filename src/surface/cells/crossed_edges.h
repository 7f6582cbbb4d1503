// Edges of leaves whose ends lie in different regions, and the leaves around each.
#pragma once

#include <array>
#include <vector>

#include "base/system/progress.h"
#include "surface/cells/cell_tree.h"

namespace ombre::surface {

// A crossed edge of a smallest leaf around it: no leaf around it has shorter sides.
struct CrossedEdge {
  CellPlace start{};  // units
  uint8_t axis = 0, level = 0;
  Label from = 0, to = 0;  // regions at its first and last corner
  // Leaves around the edge: in leaves[n] the edge has offsets quad_offsets[n]. A leaf larger than the edge occurs
  // twice.
  std::array<uint32_t, 4> leaves{};
};
constexpr std::array<std::array<int, 2>, 4> quad_offsets{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

// Returns the unit at the edge's start that lies in leaf number `corner` around it.
CellPlace unit_beside(const CrossedEdge& edge, size_t corner);

// A crossed edge with the one leaf that lists it.
struct ListedEdge {
  uint32_t leaf = 0;
  CrossedEdge edge;
};

// Returns the crossed edges listed by all leaves, or by leaves near growth only, in order of leaves, then axes. Leaves
// around them are CellTree::none if the tree does not have that cell of the grid. Throws Cancelled.
std::vector<ListedEdge> crossed_edges(const CellTree& tree, bool only_near_growth, int threads,
                                      const StopFlag* stop = nullptr);
// Returns the crossed edges that the given leaves list.
std::vector<ListedEdge> crossed_edges(const CellTree& tree, const std::vector<uint32_t>& leaves, int threads,
                                      const StopFlag* stop = nullptr);

}  // namespace ombre::surface
