#include "surface/outline/outline.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/text/error.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

using program::Builder;
using program::Field;

// Returns a cup: a cylinder of 8 mm with a conical hollow, whose radius grows with the height.
Partition cup() {
  return solid_where_negative([](Builder& b) {
    const Field far = length(b.input(0) - 10.1, b.input(1) - 9.8);
    return max(far - 8, b.input(2) - far);
  });
}

}  // namespace

TEST(PolygonArea, IsPositiveIfThePolygonTurnsLeft) {
  EXPECT_EQ(area_mm2(Polygon{{1, 1}, {4, 1}, {4, 3}, {1, 3}}), 6);
  EXPECT_EQ(area_mm2(Polygon{{1, 3}, {4, 3}, {4, 1}, {1, 1}}), -6);
  EXPECT_EQ(area_mm2(Polygon{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}}), 3);  // not convex
  EXPECT_EQ(area_mm2(Polygon{}), 0);
  const std::vector<Polygon> with_hole{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  EXPECT_EQ(area_mm2(with_hole), 15);
}

TEST(Outline, OfEachLayerHasItsAreaAndHoles) {
  const Partition partition = cup();
  const Outliner outliner(partition, corners_from_origin({21, 21, 9}), 0.02);
  for (const int64_t k : {0, 3, 6}) {
    const LayerOutline layer = outliner.layer(k);
    ASSERT_EQ(layer.regions.size(), 1U);
    const std::vector<Polygon>& polygons = layer.regions[0];
    const double hollow = static_cast<double>(k);
    ASSERT_EQ(polygons.size(), k == 0 ? 1U : 2U) << k;
    EXPECT_NEAR(area_mm2(polygons), std::numbers::pi * (64 - hollow * hollow), 0.02 * 2 * std::numbers::pi * 16) << k;
    EXPECT_GT(area_mm2(polygons[0]), 0);
    if (k > 0) {
      EXPECT_LT(area_mm2(polygons[1]), 0) << "a hole turns right";
    }
    for (const Vec2 p : polygons[0]) EXPECT_NEAR(length(p - Vec2{10.1, 9.8}), 8, 0.1);
  }
  EXPECT_TRUE(outliner.layer(8).regions[0].empty());
}

// A solid without end is cut off within the outermost cells.
TEST(Outline, EndsAtTheOutermostCorners) {
  const Partition full = solid_where_negative([](Builder& b) { return b.constant(-1); });
  const LayerOutline layer = Outliner(full, corners_from_origin({11, 11, 3}), 0.1).layer(1);
  ASSERT_EQ(layer.regions[0].size(), 1U);
  for (const Vec2 p : layer.regions[0][0]) {
    EXPECT_GE(std::min(p.x, p.y), 0);
    EXPECT_LE(std::max(p.x, p.y), 10);
  }
  const double area = area_mm2(layer.regions[0]);
  EXPECT_GE(area, 64 - 1e-6);
  EXPECT_LE(area, 100 + 1e-6);
}

TEST(Outline, StopsOnRequest) {
  const Partition partition = cup();
  StopFlag stop;
  stop.request();
  EXPECT_THROW(Outliner(partition, corners_from_origin({21, 21, 9}), 0.02).layer(3, &stop), Cancelled);
}

}  // namespace ombre::surface
