#include "surface/mesh/refinement.h"

#include <algorithm>

#include "surface/cells/point_labels.h"

namespace ombre::surface {
namespace {

// Greatest difference in level between leaves around a crossed edge.
constexpr int most_level_difference = 1;

void sort_once(Growth& growth) {
  std::ranges::sort(growth.cut);
  growth.cut.erase(std::unique(growth.cut.begin(), growth.cut.end()), growth.cut.end());
  std::ranges::sort(growth.taken_in);
  growth.taken_in.erase(std::unique(growth.taken_in.begin(), growth.taken_in.end()), growth.taken_in.end());
}

// Returns the leaves to subdivide next, so that after repeated calls the hidden edges are edges of leaves.
Growth growth_within(const CellTree& tree, const std::vector<CrossedEdge>& hidden) {
  Growth growth;
  for (const CrossedEdge& edge : hidden) {
    const uint32_t leaf = tree.find(edge.start);
    if (tree.leaves()[leaf].level > edge.level) growth.cut.push_back(leaf);
  }
  sort_once(growth);
  return growth;
}

// Returns the growth after which leaves around the crossed edges are mixed, and at most slightly larger than the edges.
Growth growth_around(const CellTree& tree, const std::vector<ListedEdge>& edges, bool may_cut) {
  Growth growth;
  for (const auto& [leaf_of_edge, edge] : edges)
    for (size_t corner = 0; corner < 4; ++corner) {
      const uint32_t number = edge.leaves[corner];
      if (number == CellTree::none) {
        growth.taken_in.push_back(grid_cell_of(unit_beside(edge, corner)));
        continue;
      }
      const Leaf& leaf = tree.leaves()[number];
      const bool is_too_large = leaf.level > edge.level + most_level_difference || !leaf.is_mixed();
      if (may_cut && is_too_large) growth.cut.push_back(number);
    }
  sort_once(growth);
  return growth;
}

}  // namespace

void refine(CellTree& tree, Growth first, const std::vector<CrossedEdge>& hidden, size_t most_leaves,
            const Partition& partition, int threads, const StopFlag* stop) {
  const auto ask = [&](const std::vector<CellPlace>& corners) {
    std::vector<Vec3> points;
    for (const CellPlace& corner : corners) points.push_back(tree.point(corner));
    std::vector<Label> labels = labels_at(partition, points, threads, stop);
    for (size_t n = 0; n < corners.size(); ++n)
      if (tree.is_outermost(corners[n])) labels[n] = 0;
    return labels;
  };
  for (const CrossedEdge& edge : hidden) first.taken_in.push_back(grid_cell_of(edge.start));
  sort_once(first);
  tree.forget_growth();
  tree.grow(first, ask);
  for (Growth more = growth_within(tree, hidden); !more.is_empty(); more = growth_within(tree, hidden))
    tree.grow(more, ask);
  tree.grow_on(growth_around(tree, crossed_edges(tree, true, threads, stop), true), ask,
               [&](const std::vector<uint32_t>& grown) {
                 const bool may_cut = tree.leaves().size() < most_leaves;
                 return growth_around(tree, crossed_edges(tree, grown, threads, stop), may_cut);
               });
}

}  // namespace ombre::surface
