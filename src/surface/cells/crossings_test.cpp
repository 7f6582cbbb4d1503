#include "surface/cells/crossings.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "surface/cells/point_labels.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr Vec3 middle_of_ball{8.1, 7.7, 8.3};
constexpr double radius_of_ball = 5.2;

const Partition& some_ball() {
  static const Partition ball = ball_of(middle_of_ball, radius_of_ball);
  return ball;
}

CellTree tree_of_ball() { return CellTree(find_mixed_cells(some_ball().label, corners_from_origin({17, 17, 17}), 1)); }

bool is_in_ball(Vec3 p) { return length(p - middle_of_ball) < radius_of_ball; }

std::vector<Label> labels_of_ball(const CellTree& tree, const std::vector<CellPlace>& corners) {
  std::vector<Label> labels;
  for (const CellPlace& corner : corners) labels.push_back(is_in_ball(tree.point(corner)) ? 1 : 0);
  return labels;
}

void expect_on_ball(const std::vector<Crossing>& crossings) {
  for (const Crossing& crossing : crossings) {
    const Vec3 radius = crossing.at - middle_of_ball;
    EXPECT_NEAR(length(radius), radius_of_ball, 1e-7);
    const double outwards = crossing.edge.from == 1 ? 1 : -1;
    EXPECT_LT(length(crossing.normal - (outwards / radius_of_ball) * radius), 1e-6);
  }
}

}  // namespace

TEST(Crossings, LieOnTheBallWithItsRadiiAsNormals) {
  const CellTree tree = tree_of_ball();
  const std::vector<Crossing> crossings = find_crossings(some_ball(), tree, 1);
  expect_on_ball(crossings);
  size_t crossed = 0;
  for (int32_t k = 0; k < 16; ++k)
    for (int32_t j = 0; j < 16; ++j)
      for (int32_t i = 0; i < 16; ++i) {
        const Vec3 at{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        for (const Vec3 along : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
          crossed += is_in_ball(at) != is_in_ball(at + along) ? 1 : 0;
      }
  EXPECT_EQ(crossings.size(), crossed);
}

TEST(Crossings, AreTheSameForAnyNumberOfThreads) {
  const CellTree tree = tree_of_ball();
  const std::vector<Crossing> one = find_crossings(some_ball(), tree, 1), three = find_crossings(some_ball(), tree, 3);
  ASSERT_EQ(one.size(), three.size());
  for (size_t n = 0; n < one.size(); ++n) {
    EXPECT_EQ(one[n].at, three[n].at);
    EXPECT_EQ(one[n].normal, three[n].normal);
    EXPECT_EQ(one[n].edge.start, three[n].edge.start);
  }
}

TEST(Crossings, AfterGrowthAreThoseOfTheGrownTree) {
  CellTree tree = tree_of_ball();
  const std::vector<Crossing> before = find_crossings(some_ball(), tree, 1);
  const std::vector<Leaf> leaves = tree.leaves();
  tree.forget_growth();
  tree.grow({{3, 40, 41, 90}, {}},
            [&](const std::vector<CellPlace>& corners) { return labels_of_ball(tree, corners); });
  const std::vector<Crossing> grown =
      find_crossings_after_growth(some_ball(), tree, before, numbers_after_growth(leaves, tree.leaves()), 1);
  const std::vector<Crossing> anew = find_crossings(some_ball(), tree, 1);
  ASSERT_EQ(grown.size(), anew.size());
  EXPECT_GT(grown.size(), before.size());
  size_t kept = 0;
  for (size_t n = 0; n < grown.size(); ++n) {
    EXPECT_EQ(grown[n].edge.start, anew[n].edge.start);
    EXPECT_EQ(grown[n].edge.leaves, anew[n].edge.leaves);
    EXPECT_LT(length(grown[n].at - anew[n].at), 1e-7);
    if (grown[n].before == Crossing::none) continue;
    ++kept;
    EXPECT_EQ(grown[n].at, before[grown[n].before].at);
    EXPECT_EQ(grown[n].edge.start, before[grown[n].before].edge.start);
  }
  EXPECT_GT(kept, before.size() / 2);
  expect_on_ball(grown);
}

TEST(Crossings, StopOnRequest) {
  StopFlag stop;
  stop.request();
  EXPECT_THROW(find_crossings(some_ball(), tree_of_ball(), 1, nullptr, &stop), Cancelled);
}

}  // namespace ombre::surface
