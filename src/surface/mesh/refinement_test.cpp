#include "surface/mesh/refinement.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "surface/cells/hidden_edges.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr size_t many_leaves = 1'000'000;
const voxel::Lattice refined_grid = corners_from_origin({13, 13, 13});

// Checks that leaves around crossed edges are mixed, and at most twice as large as the edges.
void expect_balanced(const CellTree& tree) {
  for (const ListedEdge& listed : crossed_edges(tree, false, 1))
    for (const uint32_t number : listed.edge.leaves) {
      ASSERT_NE(number, CellTree::none);
      EXPECT_TRUE(tree.leaves()[number].is_mixed());
      EXPECT_LE(tree.leaves()[number].level, listed.edge.level + 1);
    }
}

}  // namespace

TEST(Refinement, CutsNeighboursThatWouldBeMuchLarger) {
  const Partition ball = ball_of({6.1, 5.8, 6.3}, 4);
  CellTree tree(find_mixed_cells(ball.label, refined_grid, 1));
  const size_t before = tree.leaves().size();
  for (int round = 0; round < 4; ++round) {
    const uint32_t next = tree.find(tree.unit_at({6.1, 5.8, 10.3}));
    ASSERT_NE(next, CellTree::none);
    EXPECT_EQ(tree.leaves()[next].level, grid_level - round);
    refine(tree, {{next, next}, {}}, {}, many_leaves, ball, 1, nullptr);
    expect_balanced(tree);
  }
  EXPECT_GT(tree.leaves().size(), before + size_t{4} * 7);
}

TEST(Refinement, MakesHiddenEdgesEdgesOfLeaves) {
  const Partition pocket_in_space = ball_of({6.4, 5.5, 6.5}, 0.3);
  CellTree tree(find_mixed_cells(pocket_in_space.label, refined_grid, 1));
  ASSERT_TRUE(tree.leaves().empty());
  std::vector<CrossedEdge> hidden;
  find_hidden_edges(pocket_in_space.label, tree, 1, nullptr, [&](const std::vector<CrossedEdge>& edges) {
    hidden.insert(hidden.end(), edges.begin(), edges.end());
    return true;
  });
  ASSERT_FALSE(hidden.empty());
  refine(tree, {}, hidden, many_leaves, pocket_in_space, 1, nullptr);
  expect_balanced(tree);
  for (const CrossedEdge& edge : hidden) {
    const uint32_t leaf = tree.find(edge.start);
    ASSERT_NE(leaf, CellTree::none);
    EXPECT_LE(tree.leaves()[leaf].level, edge.level);
  }
}

TEST(Refinement, EndsWhereThereAreEnoughLeaves) {
  const Partition ball = ball_of({6.1, 5.8, 6.3}, 4);
  CellTree free(find_mixed_cells(ball.label, refined_grid, 1)), bound = free;
  Growth all;
  for (uint32_t n = 0; n < free.leaves().size(); n += 2) all.cut.push_back(n);
  refine(free, all, {}, many_leaves, ball, 1, nullptr);
  refine(bound, all, {}, 1, ball, 1, nullptr);
  EXPECT_LE(bound.leaves().size(), free.leaves().size());
  StopFlag stop;
  stop.request();
  EXPECT_THROW(refine(free, {{0}, {}}, {}, many_leaves, ball, 1, &stop), Cancelled);
}

}  // namespace ombre::surface
