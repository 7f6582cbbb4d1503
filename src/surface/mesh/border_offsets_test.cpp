#include "surface/mesh/border_offsets.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

const Vec3 outwards{0.6, 0, 0.8};

}  // namespace

TEST(BorderOffsets, AreSignedDistancesAlongTheNormal) {
  const Partition ball = ball_of({0, 0, 0}, 3);
  const std::vector<BorderSample> samples{{2.9 * outwards, outwards, 1, 0},
                                          {3.125 * outwards, outwards, 1, 0},
                                          {2.9 * outwards, -outwards, 0, 1},
                                          {3 * outwards, {0, 1, 0}, 1, 0}};
  const auto offsets = border_offsets(ball, samples, 0.25, 1);
  ASSERT_EQ(offsets.size(), 4U);
  EXPECT_NEAR(offsets[0].value(), 0.1, 1e-8);
  EXPECT_NEAR(offsets[1].value(), -0.125, 1e-8);
  EXPECT_NEAR(offsets[2].value(), -0.1, 1e-8);
  EXPECT_FALSE(offsets[3]) << "along the border, both ends are outside";
}

TEST(BorderOffsets, EndAtTheReach) {
  const Partition ball = ball_of({0, 0, 0}, 3);
  EXPECT_FALSE(border_offsets(ball, {{2.7 * outwards, outwards, 1, 0}}, 0.25, 1)[0]);
  EXPECT_FALSE(border_offsets(ball, {{2.9 * outwards, outwards, 0, 1}}, 0.25, 1)[0]) << "the other way round";
  EXPECT_TRUE(border_offsets(ball, {}, 0.25, 1).empty());
}

TEST(BorderOffsets, AreTheSameForManySamplesAndThreads) {
  const Partition ball = ball_of({0, 0, 0}, 3);
  std::vector<BorderSample> samples;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 radius{std::cos(n), std::sin(n), 0};
    samples.push_back({(3 + 0.2 * std::sin(3.0 * n)) * radius, radius, 1, 0});
  }
  const auto offsets = border_offsets(ball, samples, 0.25, 3);
  for (int n = 0; n < 20000; ++n)
    ASSERT_NEAR(offsets[static_cast<size_t>(n)].value(), -0.2 * std::sin(3.0 * n), 1e-8) << n;
  StopFlag stop;
  stop.request();
  EXPECT_THROW(border_offsets(ball, samples, 0.25, 2, &stop), Cancelled);
}

}  // namespace ombre::surface
