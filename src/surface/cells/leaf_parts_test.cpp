#include "surface/cells/leaf_parts.h"

#include <gtest/gtest.h>

#include "surface/cells/cell_parts.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

// A tree of one cell with these corners, and the crossings of its edges.
struct OneLeaf {
  explicit OneLeaf(const std::array<Label, 8>& corners)
      : tree(MixedCells(corners_from_origin({4, 4, 4}), {MixedCell{{1, 1, 1}, corners}})) {
    const Leaf& leaf = tree.leaves()[0];
    for (int number = 0; number < 12; ++number) {
      if (!leaf.crosses(number)) continue;
      CrossedEdge edge;
      for (size_t axis = 0; axis < 3; ++axis)
        edge.start[axis] = leaf.at[axis] + start_of_edge(number)[axis] * units_per_cell;
      edge.axis = static_cast<uint8_t>(axis_of_edge(number));
      edge.level = grid_level;
      edge.from = corners[first_corner(number)];
      edge.to = corners[second_corner(number)];
      around.push_back(static_cast<uint32_t>(crossings.size()));
      crossings.push_back({edge, {}, {}});
      edges.push_back(static_cast<size_t>(number));
    }
  }

  CellTree tree;
  std::vector<Crossing> crossings;
  std::vector<uint32_t> around;
  std::vector<size_t> edges;  // by crossing: the number of its edge
};

}  // namespace

TEST(LeafParts, OfCellsOfOneSizeAreThoseOfTheCell) {
  for (unsigned bits = 1; bits < 255; ++bits) {
    std::array<Label, 8> corners{};
    for (size_t n = 0; n < 8; ++n) corners[n] = bits >> n & 1U;
    const OneLeaf one(corners);
    const std::vector<uint32_t> parts = find_leaf_parts(one.tree, one.tree.leaves()[0], one.crossings, one.around);
    const CellParts wanted = find_cell_parts(corners);
    ASSERT_EQ(parts.size(), one.edges.size());
    for (size_t a = 0; a < parts.size(); ++a) {
      EXPECT_LT(parts[a], wanted.count) << bits;
      for (size_t b = 0; b < a; ++b)
        EXPECT_EQ(parts[a] == parts[b], wanted.part_of_edge[one.edges[a]] == wanted.part_of_edge[one.edges[b]]) << bits;
    }
  }
}

TEST(LeafParts, AreNumberedFromZeroInTheOrderOfTheirCrossings) {
  const OneLeaf one({1, 0, 0, 0, 0, 0, 0, 1});  // two corners, each with a part of three edges
  const std::vector<uint32_t> parts = find_leaf_parts(one.tree, one.tree.leaves()[0], one.crossings, one.around);
  ASSERT_EQ(parts.size(), 6U);
  EXPECT_EQ(parts[0], 0U);
  EXPECT_EQ(std::ranges::count(parts, 0U), 3);
  EXPECT_EQ(std::ranges::count(parts, 1U), 3);
}

}  // namespace ombre::surface
