// Tests of trees of subdivided cells.
#include "surface/cells/cell_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "surface/mesh/dual_mesh.h"

namespace ombre::surface {
namespace {

// Returns a lattice of corners 1 mm apart.
voxel::Lattice corners_of(const std::array<int64_t, 3>& count) {
  voxel::Lattice corners;
  corners.pitch = {Pitch{1, 1}, Pitch{1, 1}, Pitch{1, 1}};
  corners.count = count;
  return corners;
}

// Returns the eight cells around a corner; only that corner is inside.
CellTree cells_around_a_corner() {
  std::vector<MixedCell> cells;
  for (int32_t k = 1; k <= 2; ++k)
    for (int32_t j = 1; j <= 2; ++j)
      for (int32_t i = 1; i <= 2; ++i) {
        MixedCell cell{{i, j, k}, {}};
        cell.corners[corner_number({2 - i, 2 - j, 2 - k})] = 1;
        cells.push_back(cell);
      }
  return CellTree(MixedCells(corners_of({5, 5, 5}), std::move(cells)));
}

// Coordinate of the middle corner along each axis, in units.
constexpr int32_t middle = 2 * units_per_cell;

// Labels corners 1 if they are closer to the middle corner than 5/8 of a cell, else 0.
std::vector<Label> ball(const std::vector<CellPlace>& corners) {
  std::vector<Label> labels;
  for (const CellPlace& at : corners) {
    int32_t square = 0;
    for (const int32_t index : at) square += (index - middle) * (index - middle);
    labels.push_back(64 * square < 25 * units_per_cell * units_per_cell ? 1 : 0);
  }
  return labels;
}

// Returns two rows of eight cells.
CellTree cells_along_a_plane() {
  std::vector<MixedCell> cells;
  for (int32_t j = 1; j <= 2; ++j)
    for (int32_t i = 1; i <= 8; ++i) cells.push_back({{i, j, 1}, {1, 1, 1, 1, 0, 0, 0, 0}});
  return CellTree(MixedCells(corners_of({11, 5, 4}), std::move(cells)));
}

std::vector<Label> below_plane(const std::vector<CellPlace>& corners) {
  std::vector<Label> labels;
  for (const CellPlace& at : corners) labels.push_back(2 * at[2] < 3 * units_per_cell ? 1 : 0);
  return labels;
}

std::vector<CrossedEdge> all_crossed_edges(const CellTree& tree) {
  std::vector<CrossedEdge> edges;
  for (const ListedEdge& listed : crossed_edges(tree, false, 1)) edges.push_back(listed.edge);
  return edges;
}

// Checks that the dual mesh is closed: each of its edges occurs as often in one direction as in the other.
void expect_closed(const CellTree& tree) {
  std::vector<Crossing> crossings;
  for (const CrossedEdge& edge : all_crossed_edges(tree)) crossings.push_back({edge, {}, {1, 0, 0}});
  const DualMesh mesh = make_dual_mesh(tree, crossings, {1});
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  for (const DualQuad& quad : mesh.quads) {
    const CrossedEdge& edge = crossings[quad.crossing].edge;
    for (size_t n = 0; n < 4; ++n) {
      const uint32_t a = quad.corners[n], b = quad.corners[(n + 1) % 4];
      if (a == b) continue;
      ++sides[edge.from < edge.to ? std::pair(a, b) : std::pair(b, a)];
    }
  }
  for (const auto& [side, count] : sides) EXPECT_EQ(count, (sides[{side.second, side.first}]));
}

}  // namespace

TEST(CellTree, FindsItsLeaves) {
  CellTree tree = cells_around_a_corner();
  ASSERT_EQ(tree.leaves().size(), 8u);
  constexpr int32_t first = units_per_cell;
  EXPECT_EQ(tree.find({first, first, first}), 0u);
  EXPECT_EQ(tree.find({3 * units_per_cell - 1, middle - 1, middle - 1}), 1u);
  EXPECT_EQ(tree.find({first - 1, first, first}), CellTree::none);
  tree.grow({{0}, {}}, ball);
  EXPECT_EQ(tree.leaves().size(), 15u);
  for (uint32_t n = 0; n < tree.leaves().size(); ++n) EXPECT_EQ(tree.find(tree.leaves()[n].at), n);
}

TEST(CellTree, OfOneSizeHasAQuadForEachCrossedEdge) {
  const CellTree tree = cells_around_a_corner();
  EXPECT_EQ(all_crossed_edges(tree).size(), 6u);
  expect_closed(tree);
}

// The mesh stays closed whichever of the leaves are subdivided.
TEST(CellTree, OfManySizesIsClosed) {
  for (uint32_t which = 0; which < 256; ++which) {
    CellTree tree = cells_around_a_corner();
    std::vector<uint32_t> cut;
    for (uint32_t n = 0; n < 8; ++n)
      if (which >> n & 1) cut.push_back(n);
    tree.grow({cut, {}}, ball);
    expect_closed(tree);
    const auto beside_middle = [&] { return tree.find({middle - 1, middle - 1, middle - 1}); };
    while (tree.leaves()[beside_middle()].level > 0) {
      tree.grow({{beside_middle()}, {}}, ball);
      expect_closed(tree);
    }
  }
}

TEST(CellTree, FindsTheUnitAtAPoint) {
  const CellTree tree = cells_around_a_corner();
  const CellPlace unit{37, 2, 4 * units_per_cell - 1};
  EXPECT_EQ(tree.unit_at(tree.point(unit) + 0.5 * tree.size_mm(0)), unit);
  EXPECT_TRUE(tree.is_within(unit));
  EXPECT_FALSE(tree.is_within({37, -1, 4}));
  EXPECT_FALSE(tree.is_within({4 * units_per_cell, 2, 4}));
}

TEST(CellTree, ListsTheSameEdgesFarFromWhatGrew) {
  CellTree tree = cells_along_a_plane();
  tree.grow({{0}, {}}, below_plane);
  const std::vector<ListedEdge> before = crossed_edges(tree, false, 1);
  const std::vector<Leaf> leaves_before = tree.leaves();
  tree.forget_growth();
  tree.grow({{static_cast<uint32_t>(tree.leaves().size()) - 1}, {}}, below_plane);
  const std::vector<uint32_t> numbers = numbers_after_growth(leaves_before, tree.leaves());
  const auto far_edges = [&](const std::vector<ListedEdge>& all, const auto& number_of) {
    std::vector<std::tuple<uint32_t, CellPlace, int, int>> far;
    for (const auto& [leaf, edge] : all)
      if (const uint32_t now = number_of(leaf); now != CellTree::none && !tree.leaves()[now].is_near_growth)
        far.emplace_back(now, edge.start, edge.axis, edge.level);
    return far;
  };
  const auto same = far_edges(before, [&](uint32_t leaf) { return numbers[leaf]; });
  EXPECT_EQ(same, far_edges(crossed_edges(tree, false, 1), [](uint32_t leaf) { return leaf; }));
  EXPECT_GT(same.size(), 8u);
  for (const Leaf& leaf : tree.leaves()) EXPECT_EQ(leaf.is_near_growth, leaf.at[0] >= 7 * units_per_cell) << leaf.at[0];
  EXPECT_TRUE(tree.leaves()[0].is_near_cut);
}

TEST(CellTree, GrowsOnAsItGrowsStepByStep) {
  CellTree at_once = cells_around_a_corner(), by_steps = cells_around_a_corner();
  const auto beside_middle = [](const CellTree& tree) { return tree.find({middle - 1, middle - 1, middle - 1}); };
  while (by_steps.leaves()[beside_middle(by_steps)].level > 0) by_steps.grow({{beside_middle(by_steps)}, {}}, ball);
  at_once.grow_on({{beside_middle(at_once)}, {}}, ball, [&](const std::vector<uint32_t>& leaves) {
    const uint32_t next = beside_middle(at_once);
    EXPECT_TRUE(std::ranges::binary_search(leaves, next));
    for (const uint32_t leaf : leaves) EXPECT_EQ(at_once.find(at_once.leaves()[leaf].at), leaf);
    return at_once.leaves()[next].level > 0 ? Growth{{next}, {}} : Growth{};
  });
  ASSERT_EQ(at_once.leaves().size(), by_steps.leaves().size());
  for (size_t n = 0; n < by_steps.leaves().size(); ++n) {
    EXPECT_EQ(at_once.leaves()[n].at, by_steps.leaves()[n].at);
    EXPECT_EQ(at_once.leaves()[n].level, by_steps.leaves()[n].level);
    EXPECT_EQ(at_once.leaves()[n].corners, by_steps.leaves()[n].corners);
    EXPECT_EQ(at_once.leaves()[n].is_near_cut, by_steps.leaves()[n].is_near_cut);
  }
}

}  // namespace ombre::surface
