#include "base/math/box_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>

namespace ombre {
namespace {

std::vector<Box> scattered_boxes(size_t count) {
  std::mt19937 random(7);
  const auto number = [&](double most) { return most * static_cast<double>(random()) / 4294967295.0; };
  std::vector<Box> boxes;
  for (size_t n = 0; n < count; ++n) {
    const Vec3 at{number(10), number(10), number(1)};
    boxes.push_back({at, at + Vec3{number(1), number(2), number(0.5)}});
  }
  return boxes;
}

}  // namespace

TEST(BoxTree, FindsWhatMeetsABox) {
  for (const size_t count : {0, 1, 4, 5, 17, 300}) {
    const std::vector<Box> boxes = scattered_boxes(count);
    const BoxTree tree(boxes);
    const Box query{{2, 2, 0}, {6, 5, 1}};
    std::set<uint32_t> found, expected;
    tree.each_that_meets(query, [&](uint32_t n) { EXPECT_TRUE(found.insert(n).second); });
    for (uint32_t n = 0; n < boxes.size(); ++n)
      if (meet(query, boxes[n])) expected.insert(n);
    EXPECT_EQ(found, expected) << count;
    EXPECT_EQ(tree.meets_any(query), !expected.empty()) << count;
  }
}

TEST(BoxTree, FindsTheNearest) {
  for (const size_t count : {0, 1, 4, 5, 17, 300}) {
    const std::vector<Box> boxes = scattered_boxes(count);
    const BoxTree tree(boxes);
    for (const Vec3 point : {Vec3{3, 4, 0.5}, Vec3{-2, 5, 1}, Vec3{20, 20, 20}})
      for (const double reach : {0.2, 3.0, 30.0}) {
        const auto distance = [&](uint32_t n) { return length(boxes[n].center() - point); };
        double expected = HUGE_VAL;
        for (uint32_t n = 0; n < boxes.size(); ++n)
          if (distance(n) <= reach) expected = std::min(expected, distance(n));
        EXPECT_EQ(tree.nearest(point, reach, 0, distance), expected) << count;
        const double any = tree.nearest(point, reach, reach, distance);
        EXPECT_EQ(any <= reach, expected <= reach) << count;
      }
  }
}

TEST(BoxTree, FindsWhatIsWithinAReach) {
  for (const size_t count : {0, 1, 4, 5, 17, 300}) {
    const std::vector<Box> boxes = scattered_boxes(count);
    const BoxTree tree(boxes);
    const Vec3 point{3, 4, 2};
    std::set<uint32_t> found, expected;
    EXPECT_TRUE(tree.each_within(point, 3, [&](uint32_t n) { return found.insert(n).second; }));
    for (uint32_t n = 0; n < boxes.size(); ++n)
      if (squared_distance(point, boxes[n]) <= 9) expected.insert(n);
    EXPECT_EQ(found, expected) << count;
    size_t visits = 0;
    EXPECT_EQ(tree.each_within(point, 3, [&](uint32_t) { return ++visits < 2; }), expected.size() < 2);
    EXPECT_EQ(visits, std::min<size_t>(2, expected.size()));
  }
}

TEST(BoxTree, FindsEachPairOnce) {
  for (const size_t count : {0, 1, 4, 5, 17, 300}) {
    const std::vector<Box> boxes = scattered_boxes(count);
    const BoxTree tree(boxes);
    std::set<std::pair<uint32_t, uint32_t>> found, expected;
    for (size_t group = 0; group < tree.groups(); ++group)
      tree.each_pair_that_meets(group, [&](uint32_t a, uint32_t b) {
        EXPECT_TRUE(found.insert({std::min(a, b), std::max(a, b)}).second);
      });
    for (uint32_t a = 0; a < boxes.size(); ++a)
      for (uint32_t b = a + 1; b < boxes.size(); ++b)
        if (meet(boxes[a], boxes[b])) expected.insert({a, b});
    EXPECT_EQ(found, expected) << count;
  }
}

}  // namespace ombre
