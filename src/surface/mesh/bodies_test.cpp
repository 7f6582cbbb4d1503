// Tests of closed bodies. Euler: a closed surface without holes has V - E + F = 2.
#include "surface/mesh/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace ombre::surface {
namespace {

using Corners = std::array<uint32_t, 3>;

// Adds the tetrahedron of four vertices, of which the last is on the side to which the first three turn clockwise.
void add_tetrahedron(RegionSurface& surface, const std::array<uint32_t, 4>& v, Label back, Label front) {
  for (const Corners& corners :
       {Corners{v[0], v[2], v[1]}, Corners{v[0], v[1], v[3]}, Corners{v[1], v[2], v[3]}, Corners{v[2], v[0], v[3]}})
    surface.facets.push_back({corners, back, front});
}

int64_t euler_number(const Body& body) {
  std::set<std::pair<uint32_t, uint32_t>> sides;
  for (const Corners& t : body.triangles)
    for (size_t n = 0; n < 3; ++n) {
      EXPECT_TRUE(sides.emplace(t[n], t[(n + 1) % 3]).second) << "a side is traversed twice";
    }
  for (const auto& [a, b] : sides) EXPECT_TRUE(sides.contains({b, a})) << "the surface is open";
  return static_cast<int64_t>(body.vertices.size() + body.triangles.size()) - static_cast<int64_t>(sides.size() / 2);
}

}  // namespace

TEST(Bodies, OfATetrahedronHaveItsVolumeAndArea) {
  RegionSurface surface;
  surface.vertices = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}};
  add_tetrahedron(surface, {0, 1, 2, 3}, 1, 0);
  const Body body = body_of(surface, 1);
  EXPECT_NEAR(volume_mm3(body), 1.0 / 6, 1e-15);
  EXPECT_NEAR(area_mm2(body), 1.5 + std::sqrt(3) / 2, 1e-14);
  EXPECT_EQ(body.vertices, surface.vertices);
  EXPECT_EQ(euler_number(body), 2);
  EXPECT_TRUE(body_of(surface, 2).triangles.empty());
  EXPECT_EQ(volume_mm3(body_of(surface, 2)), 0);
}

// A region around another one has a cavity.
TEST(Bodies, AreSeenFromTheirOwnOutside) {
  RegionSurface surface;
  surface.vertices = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}};
  add_tetrahedron(surface, {0, 1, 2, 3}, 2, 0);
  add_tetrahedron(surface, {4, 5, 6, 7}, 1, 2);
  EXPECT_NEAR(volume_mm3(body_of(surface, 1)), 1.0 / 6, 1e-14);
  EXPECT_NEAR(volume_mm3(body_of(surface, 2)), 36 - 1.0 / 6, 1e-12);
  EXPECT_EQ(euler_number(body_of(surface, 2)), 4);
}

// Two tetrahedra touch in a vertex, or in an edge; each gets its own.
TEST(Bodies, ThatTouchThemselvesAreManifold) {
  RegionSurface in_a_vertex;
  in_a_vertex.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {-1, 0, 0}, {0, 0, -1}};
  add_tetrahedron(in_a_vertex, {0, 1, 2, 3}, 1, 0);
  add_tetrahedron(in_a_vertex, {0, 4, 5, 6}, 1, 0);
  RegionSurface in_an_edge;
  in_an_edge.vertices = {{0, 0, 0}, {0, 0, 2}, {1, 0, 1}, {0, 1, 1}, {-1, 0, 1}, {0, -1, 1}};
  add_tetrahedron(in_an_edge, {0, 2, 3, 1}, 1, 0);
  add_tetrahedron(in_an_edge, {0, 4, 5, 1}, 1, 0);
  for (const RegionSurface& surface : {in_a_vertex, in_an_edge}) {
    const Body body = body_of(surface, 1);
    EXPECT_EQ(body.vertices.size(), 8U);
    EXPECT_EQ(euler_number(body), 4);
    std::set<std::array<double, 3>> places;
    for (const Vec3& v : body.vertices) places.insert({v.x, v.y, v.z});
    EXPECT_EQ(places.size(), surface.vertices.size());
  }
  EXPECT_NEAR(volume_mm3(body_of(in_an_edge, 1)), 2.0 / 3, 1e-14);
}

}  // namespace ombre::surface
