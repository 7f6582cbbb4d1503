#include "surface/mesh/lost_parts.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

// A plate of 0.2 mm between the corners at z = 5 and z = 6.
Partition thin_plate() {
  return solid_where_negative([](program::Builder& b) { return abs(b.input(2) - 5.4) - 0.1; });
}

}  // namespace

TEST(LostParts, AreThoseThatNoFacetIsNear) {
  const LostParts lost = find_lost_parts(thin_plate(), {}, corners_from_origin({11, 11, 11}), 1);
  EXPECT_GT(lost.places, 0U);
  EXPECT_NEAR(std::abs(lost.first.z - 5.4), 0.1, 1e-6);
  const LostParts again = find_lost_parts(thin_plate(), {}, corners_from_origin({11, 11, 11}), 3);
  EXPECT_EQ(again.places, lost.places);
  EXPECT_EQ(again.first, lost.first);
}

TEST(LostParts, AreNoneBesideAFacet) {
  RegionSurface plate;
  plate.vertices = {{0, 0, 5.5}, {20, 0, 5.5}, {0, 20, 5.5}};
  plate.facets = {{{0, 1, 2}, 1, 0}};
  EXPECT_EQ(find_lost_parts(thin_plate(), plate, corners_from_origin({11, 11, 11}), 1).places, 0U);
}

TEST(LostParts, AreNoneOfASolidOfManyCells) {
  const PlainSurface ball(ball_of({8, 8, 8}, 5), corners_from_origin({17, 17, 17}), 0);
  EXPECT_EQ(find_lost_parts(ball.partition, ball.surface.build(), ball.options.corners, 1).places, 0U);
}

TEST(LostParts, AreNotSoughtInTheLargestGrids) {
  EXPECT_EQ(find_lost_parts(thin_plate(), {}, corners_from_origin({1000, 1000, 1000}), 1).places, 0U);
}

TEST(LostParts, AreSoughtUntilTheSearchIsStopped) {
  StopFlag stop;
  stop.request();
  EXPECT_THROW(find_lost_parts(thin_plate(), {}, corners_from_origin({11, 11, 11}), 1, &stop), Cancelled);
}

}  // namespace ombre::surface
