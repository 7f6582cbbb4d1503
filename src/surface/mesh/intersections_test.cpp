#include "surface/mesh/intersections.h"

#include <gtest/gtest.h>

#include <set>

#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

// The surface of a ball of 3 mm whose vertices tests may move.
struct BallToPierce : PlainSurface {
  BallToPierce() : PlainSurface(ball_of({5.1, 4.8, 5.3}, 3), corners_from_origin({11, 11, 11}), 0) {}

  // Returns the vertex with the greatest z.
  uint32_t top() const {
    const auto& places = surface.clusters().places();
    return static_cast<uint32_t>(std::ranges::max_element(places, {}, &Vec3::z) - places.begin());
  }
};

}  // namespace

TEST(Intersections, ABallHasNone) {
  BallToPierce ball;
  IntersectionFinder finder({2});
  EXPECT_TRUE(finder.find(ball.surface).empty());
}

TEST(Intersections, AreThoseOfFacetsThatPassThroughOthers) {
  BallToPierce ball;
  IntersectionFinder finder({1});
  finder.find(ball.surface);
  const uint32_t top = ball.top();
  const Vec3 before = ball.surface.clusters().places()[top];
  ball.surface.move(top, before - Vec3{0, 0, 8});  // 2 mm below the ball
  ball.surface.refresh();
  const QuadPairs pairs = finder.find(ball.surface);
  ASSERT_FALSE(pairs.empty());
  const auto around = ball.surface.quads_around(top);
  std::set<uint32_t> moved(around.begin(), around.end()), pierced;
  for (const auto& [a, b] : pairs) {
    EXPECT_LE(a, b);
    EXPECT_TRUE(moved.contains(a) || moved.contains(b));
    pierced.insert(moved.contains(a) ? b : a);
  }
  EXPECT_TRUE(std::ranges::is_sorted(pairs));
  // The others are where the spike leaves the ball, at the bottom.
  for (const uint32_t quad : pierced) {
    if (moved.contains(quad)) continue;
    for (const Triangle& triangle : ball.surface.triangles(quad))
      for (const Vec3 corner : ball.surface.corners(triangle)) EXPECT_LT(corner.z, 5.3);
  }
  EXPECT_EQ(IntersectionFinder({1}).find(ball.surface), pairs) << "a search from the beginning";
  EXPECT_EQ(finder.find(ball.surface), pairs) << "what is not mended is found again";
  ball.surface.move(top, before);
  ball.surface.refresh();
  EXPECT_TRUE(finder.find(ball.surface).empty());
}

}  // namespace ombre::surface
