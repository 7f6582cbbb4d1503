// Tests of the points nearest to planes.
#include "surface/cells/quadric.h"

#include <gtest/gtest.h>

namespace ombre::surface {
namespace {

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12); }

}  // namespace

TEST(Quadric, OfOnePlaneIsTheMean) {
  Quadric planes;
  planes.add({1, 0, 5}, {0, 0, 1});
  planes.add({3, 2, 5}, {0, 0, 1});
  expect_near(planes.least().at, {2, 1, 5});
  EXPECT_NEAR(planes.least().rms_mm, 0, 1e-12);
}

TEST(Quadric, OfTwoPlanesIsOnTheirEdgeNearestToTheMean) {
  Quadric planes;
  planes.add({0, 1, 2}, {1, 0, 0});
  planes.add({1, 0, 4}, {0, 1, 0});
  expect_near(planes.least().at, {0, 0, 3});
}

TEST(Quadric, OfThreePlanesIsTheirCorner) {
  Quadric planes, third;
  planes.add({7, 1, 1}, {1, 0, 0});
  planes.add({1, 8, 1}, {0, 0.6, 0.8});
  third.add({1, 1, 9}, {0, -0.8, 0.6});
  planes.add(third);
  // The planes are x = 7, 0.6 y + 0.8 z = 5.6 and -0.8 y + 0.6 z = 4.6.
  expect_near(planes.least().at, {7, 0.6 * 5.6 - 0.8 * 4.6, 0.8 * 5.6 + 0.6 * 4.6});
}

TEST(Quadric, SaysHowFarThePlanesAre) {
  Quadric planes;
  planes.add({0, 0, 1}, {0, 0, 1});
  planes.add({0, 0, -1}, {0, 0, 1});
  EXPECT_NEAR(planes.least().rms_mm, 1, 1e-12);
}

}  // namespace ombre::surface
