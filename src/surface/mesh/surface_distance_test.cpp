#include "surface/mesh/surface_distance.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr std::array<Vec3, 3> right_triangle{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 3, 0}};

}  // namespace

TEST(TriangleDistance, IsToTheFaceASideOrACorner) {
  EXPECT_EQ(distance_to_triangle({1, 1, 2}, right_triangle), 2);
  EXPECT_EQ(distance_to_triangle({1, 1, 0}, right_triangle), 0);
  EXPECT_EQ(distance_to_triangle({2, -3, 4}, right_triangle), 5);     // beside the side y = 0
  EXPECT_EQ(distance_to_triangle({-3, -4, 12}, right_triangle), 13);  // beside the corner (0, 0, 0)
  EXPECT_EQ(distance_to_triangle({7, -4, 0}, right_triangle), 5);     // beside the corner (4, 0, 0)
  // The side from (4, 0) to (0, 3) is 5 long; the point lies 1 beyond its middle, along its normal (0.6, 0.8).
  EXPECT_NEAR(distance_to_triangle({2.6, 2.3, 0}, right_triangle), 1, 1e-15);
}

TEST(TriangleDistance, DoesNotDependOnTheOrderOfCorners) {
  const auto [a, b, c] = right_triangle;
  for (const Vec3 p : {Vec3{1, 1, 2}, Vec3{-1, 5, 1}, Vec3{3, 3, -1}}) {
    EXPECT_NEAR(distance_to_triangle(p, {c, b, a}), distance_to_triangle(p, right_triangle), 1e-15);
    EXPECT_NEAR(distance_to_triangle(p, {b, c, a}), distance_to_triangle(p, right_triangle), 1e-15);
  }
}

TEST(TriangleDistance, OfWhatIsNoTriangleIsToItsSideOrPoint) {
  EXPECT_EQ(distance_to_triangle({3, 4, 0}, {Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 0}}), 5);
  EXPECT_EQ(distance_to_triangle({1, 2, 0}, {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}}), 2);
  EXPECT_EQ(distance_to_triangle({5, 4, 0}, {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{1, 0, 0}}), 5);
}

TEST(FarSamples, AreThoseWithoutABorderWithinReach) {
  const Partition half = half_space({0, 0, 1}, 0);
  const std::vector<SurfaceSample> samples{
      {{0, 0, 0.05}, {0, 0, 1}}, {{0, 0, 0.2}, {0, 0, 1}}, {{1, 2, -0.3}, {0, 0, 1}}, {{1, 2, -0.05}, {1, 0, 0}}};
  const FarSamples found = find_far_samples(half, samples, 0.1, 1);
  EXPECT_EQ(found.far, (std::vector<uint32_t>{1, 2}));
  EXPECT_EQ(found.beside, std::vector<uint32_t>{3}) << "its normal misses the border";
}

TEST(FarSamples, SayHowFarTheFarthestIs) {
  const Partition half = half_space({0, 0, 1}, 0);
  for (const double far : {0.11, 0.3, 0.77, 1.1}) {
    const double found = farthest_mm(half, {{{0, 0, 0.01}, {0, 0, 1}}, {{3, 0, -far}, {0, 0, 1}}}, 0.1, 1);
    EXPECT_GE(found, far);
    EXPECT_LE(found, 1.25 * far + 1e-12);
  }
  EXPECT_NEAR(farthest_mm(half, {{{0, 0, 0.01}, {0, 0, 1}}}, 0.1, 1), 0.1, 1e-12);
  EXPECT_NEAR(farthest_mm(half, {{{0, 0, 40}, {0, 0, 1}}}, 0.1, 1), 1.6, 1e-12);
}

TEST(FarSamples, AreNotSoughtOnceWorkIsStopped) {
  StopFlag stop;
  stop.request();
  EXPECT_THROW(find_far_samples(half_space({0, 0, 1}, 0), {{{0, 0, 1}, {0, 0, 1}}}, 0.1, 1, &stop), Cancelled);
}

}  // namespace ombre::surface
