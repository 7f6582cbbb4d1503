#include "surface/cells/crossed_edges.h"

#include <algorithm>

#include "base/system/tasks.h"
#include "base/text/error.h"

namespace ombre::surface {
namespace {

class Lister {
 public:
  explicit Lister(const CellTree& tree) : tree_(tree) {}

  void list(uint32_t number, std::vector<ListedEdge>& edges) const {
    const Leaf& leaf = tree_.leaves()[number];
    for (const std::array<int, 2> offsets : {std::array{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
      // Around an edge between cells of equal size, the cell in which the edge has offsets 0, 0 lists it.
      if (!leaf.is_near_cut && offsets != std::array{0, 0}) return;
      for (int axis = 0; axis < 3; ++axis) {
        const int number_of_edge = edge_number(axis, offsets[0], offsets[1]);
        if (leaf.crosses(number_of_edge)) add(leaf, number, number_of_edge, edges);
      }
    }
  }

 private:
  void add(const Leaf& leaf, uint32_t number, int number_of_edge, std::vector<ListedEdge>& edges) const {
    CrossedEdge edge;
    const std::array<int, 3> offsets = start_of_edge(number_of_edge);
    for (size_t axis = 0; axis < 3; ++axis) edge.start[axis] = leaf.at[axis] + offsets[axis] * (1 << leaf.level);
    edge.axis = static_cast<uint8_t>(axis_of_edge(number_of_edge));
    edge.level = leaf.level;
    edge.from = leaf.corners[first_corner(number_of_edge)];
    edge.to = leaf.corners[second_corner(number_of_edge)];
    bool is_listed = false;
    for (size_t corner = 0; corner < 4; ++corner) {
      const uint32_t other = edge.leaves[corner] = tree_.find(unit_beside(edge, corner));
      if (other == CellTree::none) continue;
      const uint8_t level = tree_.leaves()[other].level;
      if (level < leaf.level) return;
      // If several leaves have the whole edge, the first of them in the order around the edge lists it.
      if (level == leaf.level && !is_listed && other != number) return;
      is_listed |= other == number;
    }
    edges.push_back({number, edge});
  }

  const CellTree& tree_;
};

}  // namespace

CellPlace unit_beside(const CrossedEdge& edge, size_t corner) {
  CellPlace unit = edge.start;
  unit[(edge.axis + 1U) % 3] -= quad_offsets[corner][0];
  unit[(edge.axis + 2U) % 3] -= quad_offsets[corner][1];
  return unit;
}

std::vector<ListedEdge> crossed_edges(const CellTree& tree, bool only_near_growth, int threads, const StopFlag* stop) {
  std::vector<uint32_t> leaves;
  leaves.reserve(tree.leaves().size());
  for (uint32_t n = 0; n < tree.leaves().size(); ++n)
    if (tree.leaves()[n].is_near_growth || !only_near_growth) leaves.push_back(n);
  return crossed_edges(tree, leaves, threads, stop);
}

std::vector<ListedEdge> crossed_edges(const CellTree& tree, const std::vector<uint32_t>& leaves, int threads,
                                      const StopFlag* stop) {
  constexpr size_t piece = 4096;
  std::vector<std::vector<ListedEdge>> pieces((leaves.size() + piece - 1) / piece);
  run_parallel(pieces.size(), threads, [&](size_t p) {
    if (stop && stop->requested()) return;
    const Lister lister(tree);
    for (size_t n = p * piece; n < std::min((p + 1) * piece, leaves.size()); ++n) lister.list(leaves[n], pieces[p]);
  });
  size_t count = 0;
  for (const auto& part : pieces) count += part.size();
  std::vector<ListedEdge> all;
  all.reserve(count);
  for (const auto& part : pieces) {
    if (stop && stop->requested()) throw Cancelled();
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace ombre::surface
