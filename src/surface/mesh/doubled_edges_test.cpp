// Tests of edges shared by more than two facets.
#include "surface/mesh/doubled_edges.h"

#include <gtest/gtest.h>

#include <map>

namespace ombre::surface {
namespace {

RegionSurface tetrahedron() {
  RegionSurface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& corners : {std::array<uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    surface.facets.push_back({corners, 1, 0});
  return surface;
}

void expect_each_side_once(const RegionSurface& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  for (const Facet& facet : surface.facets)
    for (size_t n = 0; n < 3; ++n) ++sides[{facet.corners[n], facet.corners[(n + 1) % 3]}];
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1) << side.first << " to " << side.second;
    EXPECT_EQ(sides.count({side.second, side.first}), 1u);
  }
}

}  // namespace

TEST(DoubledEdges, OfFacetsUponEachOtherAreLeftOut) {
  RegionSurface surface = tetrahedron();
  surface.vertices.push_back({2, 2, 2});
  surface.facets.push_back({{4, 0, 1}, 1, 0});
  surface.facets.push_back({{1, 0, 4}, 1, 0});
  cut_doubled_edges(surface);
  EXPECT_EQ(surface.facets.size(), 4u);
  expect_each_side_once(surface);
}

// A second tetrahedron shares an edge; each sheet gets its own vertex on that edge.
TEST(DoubledEdges, AreCut) {
  RegionSurface surface = tetrahedron();
  surface.vertices.push_back({0.5, -1, 0});
  surface.vertices.push_back({0.5, 0, -1});
  for (const auto& corners : {std::array<uint32_t, 3>{0, 1, 4}, {0, 5, 1}, {1, 5, 4}, {5, 0, 4}})
    surface.facets.push_back({corners, 1, 0});
  cut_doubled_edges(surface);
  EXPECT_EQ(surface.facets.size(), 12u);
  expect_each_side_once(surface);
}

}  // namespace ombre::surface
