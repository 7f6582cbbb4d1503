// Tests of chains. Euler: a connected plane graph of V junctions and E chains between F faces has V - E + F = 2.
#include "surface/outline/outline_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace ombre::surface {
namespace {

// Traces a cell with corners 00, 10, 01 and 11 in the middle of void.
OutlineGraph around_a_cell(const std::array<Label, 4>& c) {
  return trace_cells({4, 4, {0, 0, 0, 0, 0, c[0], c[1], 0, 0, c[2], c[3], 0, 0, 0, 0, 0}});
}

void expect_sound(const OutlineGraph& graph, const std::vector<OutlineChain>& chains) {
  std::multiset<uint32_t> crossings;
  for (const OutlineChain& chain : chains) {
    ASSERT_EQ(chain.nodes.size() % 2, 1U);
    EXPECT_NE(chain.left, chain.right);
    for (size_t n = 0; n < chain.nodes.size(); ++n) {
      ASSERT_EQ(is_crossing(graph, chain.nodes[n]), n % 2 == 1);
      if (n % 2 == 0) continue;
      const auto number = static_cast<uint32_t>(chain.nodes[n] - graph.vertices.size());
      const OutlineCrossing& crossing = graph.crossings[number];
      crossings.insert(number);
      // From its first to its last end, `from` is on the left of a crossing.
      const bool is_forward = crossing.ends[0] == chain.nodes[n - 1] && crossing.ends[1] == chain.nodes[n + 1];
      EXPECT_EQ(chain.left, is_forward ? crossing.from : crossing.to);
      EXPECT_EQ(chain.right, is_forward ? crossing.to : crossing.from);
    }
  }
  EXPECT_EQ(crossings.size(), graph.crossings.size());
  EXPECT_EQ(std::set<uint32_t>(crossings.begin(), crossings.end()).size(), crossings.size());
}

size_t junctions(const OutlineGraph& graph) {
  return static_cast<size_t>(std::ranges::count_if(graph.vertices, &OutlineVertex::is_junction));
}

}  // namespace

TEST(OutlineChains, RunFromJunctionToJunction) {
  for (const auto& [corners, faces] :
       {std::pair(std::array<Label, 4>{1, 1, 2, 3}, size_t{4}), std::pair(std::array<Label, 4>{1, 2, 3, 4}, size_t{5}),
        std::pair(std::array<Label, 4>{1, 1, 2, 2}, size_t{3})}) {
    const OutlineGraph graph = around_a_cell(corners);
    const std::vector<OutlineChain> chains = find_chains(graph);
    expect_sound(graph, chains);
    EXPECT_EQ(junctions(graph) + faces, chains.size() + 2);
    for (const OutlineChain& chain : chains) {
      EXPECT_FALSE(chain.is_closed());
      EXPECT_TRUE(graph.vertices[chain.nodes.front()].is_junction());
      EXPECT_TRUE(graph.vertices[chain.nodes.back()].is_junction());
    }
  }
}

TEST(OutlineChains, WithoutJunctionsAreRings) {
  // Two islands, one of them with a hole.
  const OutlineGraph graph = trace_cells({9, 5, {0, 0, 0, 0, 0, 0, 0, 0, 0,  //
                                                 0, 1, 1, 1, 0, 0, 0, 2, 0,  //
                                                 0, 1, 0, 1, 0, 0, 2, 2, 0,  //
                                                 0, 1, 1, 1, 0, 0, 0, 0, 0,  //
                                                 0, 0, 0, 0, 0, 0, 0, 0, 0}});
  const std::vector<OutlineChain> chains = find_chains(graph);
  expect_sound(graph, chains);
  ASSERT_EQ(chains.size(), 3U);
  for (const OutlineChain& chain : chains) EXPECT_TRUE(chain.is_closed());
  // The hole's border has 4 crossings and as many vertices, and repeats its first node.
  EXPECT_EQ(std::ranges::count_if(chains, [](const OutlineChain& chain) { return chain.nodes.size() == 9; }), 1);
  EXPECT_TRUE(find_chains({}).empty());
}

}  // namespace ombre::surface
