// Tests of borders in single cells, whose labels are written by hand.
#include "surface/outline/outline_cells.h"

#include <gtest/gtest.h>

#include "surface/outline/outline_overlaps.h"
#include "surface/outline/outline_simplify.h"

namespace ombre::surface {
namespace {

// Traces one cell with corners 00, 10, 01 and 11, surrounded by void.
OutlineGraph trace(Label a, Label b, Label c, Label d) {
  return trace_cells({4, 4, {0, 0, 0, 0, 0, a, b, 0, 0, c, d, 0, 0, 0, 0, 0}});
}

std::vector<OutlineVertex> middle_vertices(const OutlineGraph& graph) {
  std::vector<OutlineVertex> found;
  for (const OutlineVertex& v : graph.vertices)
    if (v.i == 1 && v.j == 1) found.push_back(v);
  return found;
}

// True if a part of the middle cell passes through its lower and left edges.
bool cuts_off_first_corner(const OutlineGraph& graph) {
  for (const OutlineVertex& v : middle_vertices(graph)) {
    const OutlineCrossing &p = graph.crossings[v.crossings[0]], &q = graph.crossings[v.crossings[1]];
    if (p.i == 1 && p.j == 1 && q.i == 1 && q.j == 1) return true;
  }
  return false;
}

// Returns a graph with these points as vertices and no crossings.
OutlineGraph graph_of(const std::vector<Vec2>& points) {
  OutlineGraph graph;
  for (const Vec2 p : points) graph.vertices.push_back({0, 0, 2, {}, p});
  return graph;
}

}  // namespace

TEST(OutlineCells, CheckerboardsJoinTheGreaterLabel) {
  const OutlineGraph solid = trace(1, 0, 0, 1), cut = trace(0, 1, 1, 0);
  ASSERT_EQ(middle_vertices(solid).size(), 2U);
  EXPECT_FALSE(cuts_off_first_corner(solid));
  EXPECT_TRUE(cuts_off_first_corner(cut));
  EXPECT_EQ(find_chains(solid).size(), 1U);
  EXPECT_EQ(find_chains(cut).size(), 1U);
  EXPECT_TRUE(cuts_off_first_corner(trace(1, 2, 2, 1)));
  EXPECT_FALSE(cuts_off_first_corner(trace(2, 1, 1, 2)));
  // Only one diagonal can be joined here.
  EXPECT_FALSE(cuts_off_first_corner(trace(1, 2, 3, 1)));
  EXPECT_TRUE(cuts_off_first_corner(trace(1, 2, 2, 3)));
}

TEST(OutlineCells, RegionsMeetInJunctions) {
  const auto three = middle_vertices(trace(1, 1, 2, 3)), four = middle_vertices(trace(1, 2, 3, 4));
  ASSERT_EQ(three.size(), 1U);
  EXPECT_EQ(three[0].count, 3);
  ASSERT_EQ(four.size(), 1U);
  EXPECT_EQ(four[0].count, 4);
}

TEST(OutlineCells, RegionIsOnTheLeftOfItsChain) {
  const OutlineGraph graph = trace(1, 1, 1, 1);
  const auto chains = find_chains(graph);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_TRUE(chains[0].is_closed());
  // The border around the cells has 8 vertices and 8 crossings, and repeats its first node.
  EXPECT_EQ(chains[0].nodes.size(), 17U);
  EXPECT_TRUE(trace(0, 0, 0, 0).crossings.empty());
}

TEST(OutlineOverlaps, CrossingsAndCommonLengthsCount) {
  const OutlineGraph graph = graph_of({{0, 0}, {2, 2}, {0, 2}, {2, 0}, {1, 1}, {4, 4}, {3, 0}});
  EXPECT_EQ(find_overlaps(graph, {{1, 0, {0, 1}}, {1, 0, {2, 3}}}).size(), 1U);
  EXPECT_EQ(find_overlaps(graph, {{1, 0, {0, 1}}, {1, 0, {4, 5}}}).size(), 1U);
  EXPECT_EQ(find_overlaps(graph, {{1, 0, {0, 1, 5}}}).size(), 0U);
  EXPECT_EQ(find_overlaps(graph, {{1, 0, {0, 1}}, {1, 0, {4, 6}}}).size(), 0U) << "it only touches";
}

TEST(OutlineSimplify, KeepsWhatIsFartherThanTheTolerance) {
  OutlineGraph graph = graph_of({{0, 0}, {1, 0.05}, {2, 0}, {3, 0.3}, {4, 0}});
  graph.vertices.front().count = graph.vertices.back().count = 3;
  const auto made = simplify(graph, {{1, 0, {0, 1, 2, 3, 4}}}, 0.1);
  EXPECT_EQ(made[0].nodes, (std::vector<uint32_t>{0, 2, 3, 4}));
}

// Two borders connect the same points, closer together than the tolerance. If both became the same line, the region
// would vanish.
TEST(OutlineSimplify, RegionsDoNotCollapse) {
  OutlineGraph graph = graph_of({{0, 0}, {4, 0}, {2, 0.05}, {2, -0.05}});
  graph.vertices[0].count = graph.vertices[1].count = 3;
  const auto made = simplify(graph, {{1, 2, {0, 2, 1}}, {2, 3, {0, 3, 1}}}, 1);
  EXPECT_EQ(made[0].nodes.size() + made[1].nodes.size(), 6U);
}

}  // namespace ombre::surface
