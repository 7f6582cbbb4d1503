#include "import/fields/height_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ombre::importing {
namespace {

GrayImage noise(uint32_t width, uint32_t height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  GrayImage image{width, height, {}};
  for (size_t n = 0; n < size_t{width} * height; ++n) image.values.push_back(value(random));
  return image;
}

}  // namespace

TEST(HeightSource, InterpolatesBetweenTheMiddlesOfPixels) {
  // The image's rows from the top are 0.25 0.5 and 0.75 1.
  const auto source = make_height_source("i", {2, 2, {0.25, 0.5, 0.75, 1}}, {});
  EXPECT_EQ(source->sample(0, {0.5, 1.5, 9}), 0.25);
  EXPECT_EQ(source->sample(0, {1.5, 0.5, 0}), 1);
  EXPECT_EQ(source->sample(0, {1, 1, 0}), 0.625);
  EXPECT_EQ(source->sample(0, {0.75, 1.5, 0}), 0.3125);
  EXPECT_EQ(source->sample(0, {-7, 40, 0}), 0.25);
  EXPECT_EQ(source->sample(0, {40, -7, 0}), 1);
  EXPECT_TRUE(std::isnan(source->sample(0, {std::nan(""), 1, 0})));
  EXPECT_EQ(make_height_source("i", {1, 1, {0.5}}, {})->sample(0, {0.1, 0.9, 0}), 0.5);
}

TEST(HeightSource, RangesHoldWhatPointsSay) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> across(-3, 40), up(-3, 26), part(0, 1);
  const auto source = make_height_source("i", noise(37, 23, 6), {});
  for (int n = 0; n < 2000; ++n) {
    const double size = std::pow(40, part(random)) - 1;
    const Vec3 lo{across(random), up(random), 0}, hi = lo + Vec3{size * part(random), size * part(random), 1};
    const Interval range = source->range(0, {lo, hi});
    EXPECT_TRUE(range.lo >= -1e-9 && range.hi <= 1 + 1e-9);
    for (int i = 0; i < 10; ++i)
      EXPECT_TRUE(range.contains(
          source->sample(0, {lo.x + part(random) * (hi.x - lo.x), lo.y + part(random) * (hi.y - lo.y), 0})));
  }
  // Within a pixel, the range is that of the neighbouring values.
  const auto flat = make_height_source("i", {4, 1, {0.5, 0.5, 0, 1}}, {});
  EXPECT_NEAR(flat->range(0, {{0, 0, 0}, {1.2, 1, 0}}).hi, 0.5, 1e-9);
}

TEST(HeightSource, KnowsItsSteepestSteps) {
  const auto steps = steepest_steps({3, 2, {0, 0.5F, 0.25F, 0.75F, 1, 1}});
  EXPECT_EQ(steps[0], 0.5);
  EXPECT_EQ(steps[1], 0.75);
}

}  // namespace ombre::importing
