#include "surface/cells/edge_search.h"

#include <gtest/gtest.h>

#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

using program::Builder;
using program::Field;

// Returns the search on the edge from one point to another after it has finished.
EdgeSearch searched(const Partition& partition, Vec3 from, Vec3 to, Label first, Label last) {
  PointEvaluator evaluator;
  evaluator.begin(partition, partition.details.whole());
  EdgeSearch search;
  search.start = from;
  search.along = to - from;
  search.from = first;
  search.to = last;
  search_edges(std::span(&search, 1), evaluator);
  return search;
}

// Returns a partition with a label of its own, whatever the distance says.
Partition labelled(const FieldOfSpace& is_inside, const FieldOfSpace& distance) {
  Builder builder;
  const Field label = select(is_inside(builder), builder.constant(1), builder.constant(0));
  Partition partition;
  partition.label = builder.finish({{"region", label}});
  partition.details =
      LocalPrograms(builder.finish({{"region", label}, {"distance", distance(builder)}}), Box::centered({10, 10, 10}));
  return partition;
}

Field before_a_third(Builder& b) { return b.input(0) < 1.0 / 3; }

}  // namespace

TEST(EdgeSearch, FindsWhereAnEdgeLeavesASolid) {
  const Partition ball = ball_of({0, 0, 0}, 3);
  // The line y = 1, z = 2 leaves the ball at x = 2.
  const EdgeSearch out = searched(ball, {1.5, 1, 2}, {2.5, 1, 2}, 1, 0);
  EXPECT_NEAR(out.t, 0.5, 1e-8);
  EXPECT_TRUE(out.is_between);
  EXPECT_TRUE(out.by_value);
  EXPECT_NEAR(out.rise, std::sqrt(6.25 + 5) - std::sqrt(2.25 + 5), 1e-12);
  EXPECT_NEAR(searched(ball, {4, 1, 2}, {1, 1, 2}, 0, 1).t, 2.0 / 3, 1e-8);
}

TEST(EdgeSearch, FindsCrossingsOfSteepAndFlatValues) {
  const Partition cubic =
      solid_where_negative([](Builder& b) { return square(b.input(0) - 0.7) * (b.input(0) - 0.7); });
  EXPECT_NEAR(searched(cubic, {0, 0, 0}, {1, 0, 0}, 1, 0).t, 0.7, 1e-3);  // 1e-9 mm^3 from the border
  const Partition root =
      solid_where_negative([](Builder& b) { return sqrt(max(b.input(0) - 0.7, 0)) - sqrt(max(0.7 - b.input(0), 0)); });
  EXPECT_NEAR(searched(root, {0, 0, 0}, {1, 0, 0}, 1, 0).t, 0.7, 1e-7);
}

TEST(EdgeSearch, FollowsLabelsWhereNoValueDecides) {
  const auto flat = [](Builder& b) { return b.constant(0); };
  const auto undefined = [](Builder& b) { return sqrt(b.input(0) - 100); };
  const auto jump = [](Builder& b) { return select(before_a_third(b), b.constant(-1), b.constant(5)); };
  for (const FieldOfSpace& distance : {FieldOfSpace(flat), FieldOfSpace(undefined), FieldOfSpace(jump)}) {
    const EdgeSearch search = searched(labelled(before_a_third, distance), {0, 0, 0}, {1, 0, 0}, 1, 0);
    EXPECT_NEAR(search.t, 1.0 / 3, 2e-8);
    EXPECT_TRUE(search.is_between);
  }
}

TEST(EdgeSearch, FindsBordersAtItsEnds) {
  const Partition half = half_space({1, 0, 0}, 0);
  EXPECT_EQ(searched(half, {-1, 2, 0}, {0, 2, 0}, 1, 0).t, 1);
  EXPECT_EQ(searched(half, {0, 2, 0}, {-1, 2, 0}, 0, 1).t, 0);
}

TEST(EdgeSearch, SaysIfItsEndsLieElsewhere) {
  const Partition half = half_space({1, 0, 0}, 0);
  EXPECT_FALSE(searched(half, {1, 0, 0}, {2, 0, 0}, 1, 0).is_between);
  EXPECT_FALSE(searched(half, {-2, 0, 0}, {-1, 0, 0}, 1, 0).is_between);
  EXPECT_FALSE(searched(half, {1, 0, 0}, {-1, 0, 0}, 1, 0).is_between);
}

}  // namespace ombre::surface
