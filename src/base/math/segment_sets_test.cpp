// Joins segments of known figures.
#include "base/math/segment_sets.h"

#include <gtest/gtest.h>

namespace ombre {
namespace {

TEST(SegmentSets, SegmentsInLineAreOne) {
  // A line of three pieces in mixed directions, a corner, a piece without a length and one that is there twice.
  const std::vector<Edge3> pieces{{Vec3{0, 0, 0}, Vec3{1, 1, 0}}, {Vec3{3, 3, 0}, Vec3{1, 1, 0}},
                                  {Vec3{3, 3, 0}, Vec3{4, 4, 0}}, {Vec3{4, 4, 0}, Vec3{4, 4, 1}},
                                  {Vec3{4, 4, 1}, Vec3{4, 4, 1}}, {Vec3{4, 4, 1}, Vec3{4, 4, 1e-12}}};
  const std::vector<Edge3> joined = joined_in_line(pieces, 1e-9);
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_EQ(joined[0], (Edge3{Vec3{0, 0, 0}, Vec3{4, 4, 0}}));
  EXPECT_EQ(joined[1], (Edge3{Vec3{4, 4, 0}, Vec3{4, 4, 1}}));
}

TEST(SegmentSets, SegmentsThatBendOrCrossStay) {
  const std::vector<Edge3> bent{{Vec3{0, 0, 0}, Vec3{1, 0, 0}}, {Vec3{1, 0, 0}, Vec3{2, 1e-3, 0}}};
  EXPECT_EQ(joined_in_line(bent, 1e-9), bent);
  // Lines that go on through a joint of three.
  const std::vector<Edge3> tee{
      {Vec3{0, 0, 0}, Vec3{1, 0, 0}}, {Vec3{1, 0, 0}, Vec3{2, 0, 0}}, {Vec3{1, 0, 0}, Vec3{1, 1, 0}}};
  EXPECT_EQ(joined_in_line(tee, 1e-9), (std::vector<Edge3>{{Vec3{0, 0, 0}, Vec3{2, 0, 0}}, tee[2]}));
  EXPECT_TRUE(joined_in_line({}, 1e-9).empty());
}

TEST(SegmentSets, CountsWhatMayBeNearAtOnce) {
  const std::vector<Edge3> row{
      {Vec3{0, 0, 0}, Vec3{0, 0, 5}}, {Vec3{1, 0, 0}, Vec3{1, 0, 5}}, {Vec3{9, 0, 0}, Vec3{9, 0, 5}}};
  EXPECT_EQ(most_within(row, 0.4), 1u);
  EXPECT_EQ(most_within(row, 0.6), 2u);
  EXPECT_EQ(most_within(row, 5), 3u);
  EXPECT_EQ(most_within({}, 5), 0u);
}

}  // namespace
}  // namespace ombre
