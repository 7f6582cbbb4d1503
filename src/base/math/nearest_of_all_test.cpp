// Compares what is found for many points with what is found by trying all elements.
#include "base/math/nearest_of_all.h"

#include <gtest/gtest.h>

#include <random>

namespace ombre {
namespace {

class NearestOfAllTest : public testing::Test {
 protected:
  double number(double most) { return std::uniform_real_distribution<double>(0, most)(random_); }
  Vec3 place(Vec3 size) { return {number(size.x), number(size.y), number(size.z)}; }
  std::vector<Vec3> places(size_t count, Vec3 from, Vec3 size) {
    std::vector<Vec3> made;
    for (size_t n = 0; n < count; ++n) made.push_back(from + place(size));
    return made;
  }

  // Elements are points of which each occurs twice, so that two are always nearest.
  static void expect_first_of_nearest(const std::vector<Vec3>& half, const std::vector<Vec3>& points) {
    std::vector<Vec3> elements = half;
    elements.insert(elements.end(), half.begin(), half.end());
    std::vector<Box> boxes;
    for (const Vec3 q : elements) boxes.push_back({q, q});
    const BoxTree tree(boxes);
    const auto squared = [&](Vec3 p, uint32_t n) { return dot(p - elements[n], p - elements[n]); };
    std::vector<NearestOfAll::Nearest> found(points.size());
    NearestOfAll search;
    search.find(tree, points, squared, found);
    for (size_t i = 0; i < points.size(); ++i) {
      uint32_t first = 0;
      for (uint32_t n = 1; n < elements.size(); ++n)
        if (squared(points[i], n) < squared(points[i], first)) first = n;
      EXPECT_EQ(found[i].number, first) << i << " of " << points.size();
      EXPECT_EQ(found[i].squared, squared(points[i], first));
      const auto alone = NearestOfAll::find_one(tree, points[i], std::sqrt(squared(points[i], first)), squared);
      EXPECT_EQ(alone.number, first);
    }
  }

  std::mt19937 random_{5};
};

// Points that lie near each other, are scattered, far from everything, and equal.
TEST_F(NearestOfAllTest, IsTheFirstOfTheNearest) {
  for (const size_t elements : {1, 2, 5, 40, 900}) {
    const std::vector<Vec3> half = places(elements, {0, 0, 0}, {20, 20, 2});
    for (const size_t count : {1, 4, 9, 33, 128})
      for (const auto& [from, size] :
           {std::pair{Vec3{8, 8, 3}, Vec3{0.1, 0.2, 0.1}}, std::pair{Vec3{0, 0, 0}, Vec3{20, 20, 9}},
            std::pair{Vec3{500, -900, 40}, Vec3{3, 3, 3}}, std::pair{Vec3{4, 4, 4}, Vec3{0, 0, 0}}})
        expect_first_of_nearest(half, places(count, from, size));
  }
}

// All points of a sphere are as near to its middle.
TEST_F(NearestOfAllTest, ManyAreAsNear) {
  std::vector<Vec3> shell;
  for (int n = 0; n < 700; ++n) {
    const Vec3 p = place({2, 2, 2}) - Vec3{1, 1, 1};
    if (length(p) > 0.1) shell.push_back((10 / length(p)) * p);
  }
  expect_first_of_nearest(shell, places(128, {-0.01, -0.01, -0.01}, {0.02, 0.02, 0.02}));
}

TEST_F(NearestOfAllTest, NothingIsNearInAnEmptyTree) {
  const std::vector<Vec3> points = places(20, {0, 0, 0}, {1, 1, 1});
  std::vector<NearestOfAll::Nearest> found(points.size(), {1, 1});
  NearestOfAll search;
  search.find(
      BoxTree(), points, [](Vec3, uint32_t) { return 0.0; }, found);
  for (const auto& nearest : found) EXPECT_EQ(nearest.squared, HUGE_VAL);
}

}  // namespace
}  // namespace ombre
