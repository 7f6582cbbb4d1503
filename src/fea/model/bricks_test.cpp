#include "fea/model/bricks.h"

#include <gtest/gtest.h>

#include <set>

#include "fea/model/test_models.h"

namespace ombre::fea {
namespace {

using namespace test;

TEST(Bricks, NodesAreSharedAndInOrder) {
  const Bricks bricks = block({3, 2, 4}, {1, 2, 0.5}, {10, 20, 30});
  EXPECT_EQ(bricks.node_count(), 4U * 3 * 5);
  EXPECT_EQ(bricks.node(0), (Vec3{10, 20, 30}));
  EXPECT_EQ(bricks.node(59), (Vec3{13, 24, 32}));
  EXPECT_EQ(bricks.centroid(23), (Vec3{12.5, 23, 31.75}));
  const std::set<std::array<int32_t, 3>> places(bricks.corners.begin(), bricks.corners.end());
  EXPECT_EQ(places.size(), bricks.node_count());
}

// Returns the volume by the order of corners; it is positive if the lower face turns counter-clockwise as seen from
// above.
TEST(Bricks, CornersTurnAsAbaqusAndVtkHaveThem) {
  const Bricks bricks = block({2, 2, 2}, {1, 2, 3});
  for (const auto& n : bricks.nodes) {
    const Vec3 a = bricks.node(n[1]) - bricks.node(n[0]), b = bricks.node(n[3]) - bricks.node(n[0]);
    const Vec3 c = bricks.node(n[4]) - bricks.node(n[0]);
    EXPECT_EQ(dot(cross(a, b), c), 6);
    EXPECT_EQ(bricks.node(n[2]), bricks.node(n[0]) + a + b);
    EXPECT_EQ(bricks.node(n[6]), bricks.node(n[0]) + a + b + c);
  }
}

}  // namespace
}  // namespace ombre::fea
