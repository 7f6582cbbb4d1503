#include "surface/refinement.h"

#include <algorithm>

#include "surface/label_asker.h"

namespace ombre::surface {
namespace {

// Between leaves around a crossed edge.
constexpr int most_level_difference = 1;

// What is cut and taken in so that leaves around crossed edges are mixed, and not far larger than the edges are long.
struct Growth {
  std::vector<uint32_t> cut;
  std::vector<CellPlace> taken_in;

  bool is_empty() const { return cut.empty() && taken_in.empty(); }
  void sort() {
    std::ranges::sort(cut);
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
    std::ranges::sort(taken_in);
    taken_in.erase(std::unique(taken_in.begin(), taken_in.end()), taken_in.end());
  }
};

Growth growth_to_cells_of(const std::vector<CrossedEdge>& hidden) {
  Growth growth;
  for (const CrossedEdge& edge : hidden) growth.taken_in.push_back(grid_cell_of(edge.start));
  growth.sort();
  return growth;
}

// One level of the cutting after which hidden edges are edges of leaves.
Growth growth_within(const CellTree& tree, const std::vector<CrossedEdge>& hidden) {
  Growth growth;
  for (const CrossedEdge& edge : hidden) {
    const uint32_t leaf = tree.find(edge.start);
    if (tree.leaves()[leaf].level > edge.level) growth.cut.push_back(leaf);
  }
  growth.sort();
  return growth;
}

Growth growth_around_cuts(const CellTree& tree, bool may_cut, int threads) {
  Growth growth;
  for (const auto& [leaf_of_edge, edge] : crossed_edges(tree, true, threads))
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
  growth.sort();
  return growth;
}

}  // namespace

void refine(CellTree& tree, const std::vector<uint32_t>& leaves, const std::vector<CrossedEdge>& hidden,
            size_t most_leaves, const Partition& partition, int threads, const StopFlag* stop) {
  const auto ask = [&](const std::vector<CellPlace>& corners) {
    std::vector<Vec3> points;
    for (const CellPlace& corner : corners) points.push_back(tree.point(corner));
    std::vector<Label> labels = labels_at(partition, points, threads, stop);
    for (size_t n = 0; n < corners.size(); ++n)
      if (tree.is_outermost(corners[n])) labels[n] = 0;
    return labels;
  };
  Growth first = growth_to_cells_of(hidden);
  first.cut = leaves;
  tree.grow(first.cut, first.taken_in, ask);
  for (Growth more = growth_within(tree, hidden); !more.is_empty(); more = growth_within(tree, hidden))
    tree.grow(more.cut, {}, ask);
  for (Growth more = growth_around_cuts(tree, true, threads); !more.is_empty();) {
    tree.grow(more.cut, more.taken_in, ask);
    more = growth_around_cuts(tree, tree.leaves().size() < most_leaves, threads);
  }
}

}  // namespace ombre::surface
