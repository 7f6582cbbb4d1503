#include "import/surfaces/shells.h"

#include <gtest/gtest.h>

#include "import/surfaces/mesh_report.h"
#include "import/surfaces/test_meshes.h"

namespace ombre::importing {
namespace {

using namespace test;

const Mesh plain_box = cuboid({0, 0, 0}, {10, 8, 6});
const Mesh shifted_box = cuboid({5, 4, 3}, {15, 12, 9});

void expect_unturned(Mesh mesh) {
  const Mesh before = mesh;
  EXPECT_EQ(turn_inverted_shells(mesh).turned, 0u);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

// Checks the number of turned shells and the volume afterwards.
void expect_turned(Mesh mesh, size_t turned, double volume) {
  EXPECT_EQ(turn_inverted_shells(mesh).turned, turned);
  EXPECT_NEAR(inspect(mesh).volume, volume, 1e-9);
  EXPECT_TRUE(inspect(mesh).is_closed());
}

TEST(Shells, OverlappingShellsFaceOutward) {
  expect_turned(together(plain_box, turned_inward(shifted_box)), 1, 480 + 480);
  expect_turned(together(turned_inward(shifted_box), plain_box), 1, 480 + 480);
  // Crossing bars have no corner inside of each other.
  const Mesh bar = cuboid({-10, -1, -1}, {10, 1, 1}), other = cuboid({-2, -10, -2}, {2, 10, 2});
  expect_turned(together(bar, turned_inward(other)), 1, 80 + 320);
  expect_turned(
      together(together(plain_box, turned_inward(shifted_box)), turned_inward(cuboid({-1, -1, -1}, {1, 1, 1}))), 2,
      480 + 480 + 8);
}

TEST(Shells, CavitiesStay) {
  expect_unturned(together(plain_box, turned_inward(cuboid({1, 1, 1}, {9, 7, 5}))));
  // The cavity touches the outer shell from within, or extends from one side to the other.
  expect_unturned(together(plain_box, turned_inward(cuboid({1, 1, 0}, {9, 7, 5}))));
  expect_unturned(together(plain_box, turned_inward(cuboid({1, 1, 0}, {9, 7, 6}))));
  // The cavity contains another solid.
  expect_unturned(
      together(together(plain_box, turned_inward(cuboid({1, 1, 1}, {9, 7, 5}))), cuboid({2, 2, 2}, {3, 3, 3})));
}

TEST(Shells, WhatFacesInwardAsAWholeStays) {
  expect_unturned(turned_inward(together(plain_box, shifted_box)));
  expect_unturned(turned_inward(together(plain_box, turned_inward(cuboid({1, 1, 1}, {9, 7, 5})))));
  expect_unturned(together(plain_box, turned_inward(cuboid({20, 0, 0}, {30, 8, 6}))));
}

TEST(Shells, CavitiesTurnWithTheirShell) {
  const Mesh hollow = together(shifted_box, turned_inward(cuboid({12, 9, 7}, {14, 11, 8})));
  expect_turned(together(plain_box, turned_inward(hollow)), 1, 480 + 480 - 4);
}

TEST(Shells, ShellsThatTouchAreTwo) {
  // The boxes touch in an edge, in a face and in a corner.
  for (const Vec3 at : {Vec3{10, 8, 0}, Vec3{10, 0, 0}, Vec3{10, 8, 6}}) {
    const Mesh pair = together(plain_box, cuboid(at, at + Vec3{10, 8, 6}));
    EXPECT_EQ(inspect(pair).shells, 2u);
    EXPECT_EQ(inspect(pair).inward_shells, 0u);
  }
  for (const Vec3 at : {Vec3{10, 8, 0}, Vec3{10, 8, 6}})
    EXPECT_EQ(inspect(together(plain_box, turned_inward(cuboid(at, at + Vec3{10, 8, 6})))).inward_shells, 1u);
  EXPECT_EQ(inspect(torus(7, 2, 20, 10)).shells, 1u);
}

// A box consists of two cells, with a doubled wall between them.
TEST(Shells, PartsThatAreClosedTogetherAreOne) {
  Mesh cells = together(cuboid({0, 0, 0}, {1, 1, 1}), cuboid({1, 0, 0}, {2, 1, 1}));
  EXPECT_EQ(inspect(cells).shells, 2u);
  Mesh joined = cells;
  // The wall is removed.
  std::erase_if(joined.triangles, [&](const auto& t) {
    return joined.vertices[t[0]].x == 1 && joined.vertices[t[1]].x == 1 && joined.vertices[t[2]].x == 1;
  });
  ASSERT_EQ(joined.triangles.size(), 20u);
  EXPECT_EQ(inspect(joined).shells, 1u);
}

}  // namespace
}  // namespace ombre::importing
