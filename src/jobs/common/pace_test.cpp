#include "jobs/common/pace.h"

#include <gtest/gtest.h>

namespace ombre::jobs {
namespace {

TEST(PaceMeter, WorkThatFollowsOtherWorkHasAPaceOfItsOwn) {
  PaceMeter meter(Counted::voxels, 0);
  EXPECT_FALSE(meter.update({1'000'000, 3'000'000}));
  EXPECT_TRUE(meter.update({3'000'000, 3'000'000}));
  meter.update({1, 19});
  const auto pace = meter.update({2, 19});
  ASSERT_TRUE(pace);
  EXPECT_DOUBLE_EQ(pace->share, 2.0 / 19);
  EXPECT_GE(pace->voxels_per_second, 0);
  EXPECT_LE(pace->voxels_per_second, 1e9);  // one voxel in one nanosecond, the least that the clock counts
}

TEST(PaceMeter, UpdatesOutOfOrderDoNotBeginOtherWork) {
  PaceMeter meter(Counted::voxels, 0);
  meter.update({100, 1000});
  meter.update({120, 1000});
  const auto pace = meter.update({90, 1000});
  ASSERT_TRUE(pace);
  EXPECT_DOUBLE_EQ(pace->voxels_per_second, 0);
}

}  // namespace
}  // namespace ombre::jobs
