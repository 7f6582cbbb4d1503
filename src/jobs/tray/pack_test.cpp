#include "jobs/tray/pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ombre::compile {
namespace {

// Marks each voxel of the tray: no rectangle lies beyond it, none comes nearer to another than the gap.
void expect_apart(const std::vector<Rectangle>& rectangles, const std::vector<std::optional<PackPlace>>& places,
                  Rectangle tray, int64_t gap) {
  std::vector<int> of(static_cast<size_t>(tray.width * tray.height), -1);
  for (size_t n = 0; n < places.size(); ++n) {
    if (!places[n]) continue;
    ASSERT_GE(places[n]->x, 0);
    ASSERT_GE(places[n]->y, 0);
    ASSERT_LE(places[n]->x + rectangles[n].width, tray.width);
    ASSERT_LE(places[n]->y + rectangles[n].height, tray.height);
    for (int64_t y = places[n]->y; y < places[n]->y + rectangles[n].height; ++y)
      for (int64_t x = places[n]->x; x < places[n]->x + rectangles[n].width; ++x)
        of[static_cast<size_t>(y * tray.width + x)] = static_cast<int>(n);
  }
  for (size_t n = 0; n < places.size(); ++n) {
    if (!places[n]) continue;
    for (int64_t y = places[n]->y - gap; y < places[n]->y + rectangles[n].height + gap; ++y)
      for (int64_t x = places[n]->x - gap; x < places[n]->x + rectangles[n].width + gap; ++x) {
        if (x < 0 || y < 0 || x >= tray.width || y >= tray.height) continue;
        const int there = of[static_cast<size_t>(y * tray.width + x)];
        ASSERT_TRUE(there == -1 || there == static_cast<int>(n)) << x << ' ' << y;
      }
  }
}

size_t placed(const std::vector<std::optional<PackPlace>>& places) {
  return static_cast<size_t>(std::ranges::count_if(places, [](const auto& place) { return place.has_value(); }));
}

}  // namespace

TEST(Pack, PartsLieOnTheTrayAndKeepTheGap) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    const Rectangle tray{40 + static_cast<int64_t>(random() % 60), 40 + static_cast<int64_t>(random() % 60)};
    const auto gap = static_cast<int64_t>(random() % 4);
    std::vector<Rectangle> parts(1 + random() % 40);
    for (Rectangle& part : parts)
      part = {1 + static_cast<int64_t>(random() % 25), 1 + static_cast<int64_t>(random() % 25)};
    const auto places = pack(parts, tray, {gap, gap});
    ASSERT_EQ(places.size(), parts.size());
    expect_apart(parts, places, tray, gap);
  }
}

// n equal squares of side a with a gap g fill a tray of side n a + (n - 1) g to the last voxel.
TEST(Pack, EqualPartsFillTheTray) {
  for (int64_t n = 1; n <= 7; ++n)
    for (const int64_t gap : {0, 3}) {
      const int64_t side = n * 10 + (n - 1) * gap;
      std::vector<Rectangle> parts(static_cast<size_t>(n * n), {10, 10});
      const auto all = pack(parts, {side, side}, {gap, gap});
      EXPECT_EQ(placed(all), parts.size());
      expect_apart(parts, all, {side, side}, gap);
      EXPECT_LE(placed(pack(parts, {side - 1, side}, {gap, gap})), parts.size() - static_cast<size_t>(n));
    }
}

TEST(Pack, WhatIsTooLargeFindsNoPlace) {
  const auto places = pack({{5, 5}, {11, 2}, {2, 11}, {10, 4}}, {10, 10}, {1, 1});
  EXPECT_TRUE(places[0]);
  EXPECT_FALSE(places[1]);
  EXPECT_FALSE(places[2]);
  EXPECT_TRUE(places[3]);
}

}  // namespace ombre::compile
