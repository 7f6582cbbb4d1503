#include "import/surfaces/corner_welder.h"

#include <gtest/gtest.h>

#include "import/surfaces/mesh_report.h"
#include "import/surfaces/test_meshes.h"

namespace ombre::importing {
namespace {

using namespace test;

Mesh soup_of(const Mesh& mesh, double noise) {
  std::mt19937 random(7);
  return test::apart(mesh, random, noise);
}

TEST(CornerWelder, RoundingIsMended) {
  for (const double noise : {1e-16, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5})
    for (const Mesh& mesh : {torus(7, 2, 40, 20), cuboid({-5, -5, 0}, {5, 5, 20}), sphere(10, 3)}) {
      SCOPED_TRACE(noise);
      Mesh soup = soup_of(mesh, noise);
      ASSERT_FALSE(inspect(soup).is_closed());
      const auto welded = weld_corners(soup, false);
      ASSERT_TRUE(welded);
      EXPECT_TRUE(inspect(soup).is_closed());
      EXPECT_LE(welded->farthest_mm, 2 * std::sqrt(3.0) * noise + 1e-15);
      EXPECT_GT(welded->corners, mesh.vertices.size());
      EXPECT_NEAR(inspect(soup).volume, inspect(mesh).volume, 2000 * noise + 1e-9);
    }
}

TEST(CornerWelder, FarFromTheOriginTheSizeBoundsTheTolerance) {
  Mesh soup = soup_of(moved(cuboid({0, 0, 0}, {10, 8, 6}), Affine::translation({5e5, 4.6e6, 0})), 1e-6);
  EXPECT_TRUE(weld_corners(soup, false));
  EXPECT_TRUE(inspect(soup).is_closed());
}

void expect_unchanged(Mesh mesh, bool any_direction = false) {
  const Mesh before = mesh;
  EXPECT_FALSE(weld_corners(mesh, any_direction));
  EXPECT_EQ(mesh.vertices, before.vertices);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(CornerWelder, WhatIsClosedStaysToTheLastBit) {
  expect_unchanged(torus(7, 2, 40, 20));
  // The corners are near each other, but belong to two shells.
  expect_unchanged(together(cuboid({0, 0, 0}, {1, 1, 1}), cuboid({1 + 1e-12, 0, 0}, {2, 1, 1})));
}

TEST(CornerWelder, HolesStayOpen) {
  Mesh mesh = cuboid({0, 0, 0}, {10, 10, 10});
  mesh.triangles.pop_back();
  expect_unchanged(mesh);
  expect_unchanged(soup_of(mesh, 1e-9));
}

TEST(CornerWelder, FinePartsDoNotCollapse) {
  // Rounding to floats explains at most 2.4e-6 of 10, so the plate's thickness is intended.
  const Mesh plate = cuboid({0, 0, 0}, {10, 10, 3e-5});
  expect_unchanged(soup_of(plate, 2e-5));
  Mesh soup = soup_of(plate, 1e-9);
  ASSERT_TRUE(weld_corners(soup, false));
  EXPECT_NEAR(inspect(soup).volume, 3e-3, 1e-6);
  // The hole's rim is shorter than the greatest tolerance.
  Mesh pierced = sphere(1, 4);
  for (Vec3& p : pierced.vertices)
    if (length(p - Vec3{0, 0, 1}) < 0.2) p = Vec3{1e-4 * p.x, 1e-4 * p.y, p.z};
  pierced.triangles.erase(pierced.triangles.begin());
  expect_unchanged(pierced);
}

TEST(CornerWelder, NoiseWithinATriangleVanishes) {
  // The tip of this pyramid is split into two corners with a sliver between them.
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 2}, {1 + 1e-15, 1, 2}, {1, 1 + 1e-15, 2}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 4}, {1, 5, 4}};
  ASSERT_FALSE(inspect(mesh).is_closed());
  ASSERT_TRUE(weld_corners(mesh, false));
  EXPECT_TRUE(inspect(mesh).is_closed());
  EXPECT_NEAR(inspect(mesh).volume, 8.0 / 3, 1e-12);
}

TEST(CornerWelder, DirectionsCountUnlessTheRuleIgnoresThem) {
  Mesh mesh = cuboid({0, 0, 0}, {10, 10, 10});
  std::swap(mesh.triangles[3][1], mesh.triangles[3][2]);
  expect_unchanged(soup_of(mesh, 1e-9));
  Mesh soup = soup_of(mesh, 1e-9);
  EXPECT_TRUE(weld_corners(soup, true));
  EXPECT_EQ(inspect(soup).open_edges, 0u);
}

TEST(CornerWelder, CrowdsOfCornersTakeNoTime) {
  // All vertices but one lie within a few tolerances of each other; one is far away.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1e-4);
  Mesh mesh;
  for (int i = 0; i < 30000; ++i) mesh.vertices.push_back({part(random), part(random), part(random)});
  mesh.vertices.push_back({10, 10, 10});
  for (uint32_t i = 0; i + 2 < mesh.vertices.size(); i += 2) mesh.triangles.push_back({i, i + 1, i + 2});
  expect_unchanged(mesh);
}

}  // namespace
}  // namespace ombre::importing
