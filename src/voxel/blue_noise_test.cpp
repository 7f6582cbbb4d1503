#include "voxel/blue_noise.h"

#include <gtest/gtest.h>

#include <set>

#include "voxel/test_spectrum.h"

namespace ombre::voxel {
namespace {

constexpr int64_t width = blue_noise_width, height = blue_noise_height, depth = blue_noise_depth;
constexpr int64_t tile = width * height * depth;

double draw(int64_t i, int64_t j, int64_t k, uint64_t seed = 0, const uint32_t* mask = blue_noise_draws) {
  return blue_noise_row(mask, seed, j, k)[i] * 0x1p-24;
}

// The masks for square voxels, and for voxels that are longer along y.
constexpr const uint32_t* masks[] = {blue_noise_draws, blue_noise_long_draws};

// Returns the voxels in layer k whose draw lies in [from, to).
SquarePattern layer(int64_t k, double from, double to, uint64_t seed = 0, const uint32_t* mask = blue_noise_draws) {
  return {width, [=](int64_t i, int64_t j) {
            const double value = draw(i, j, k, seed, mask);
            return value >= from && value < to;
          }};
}

std::vector<SquarePattern> layers(double from, double to, const uint32_t* mask = blue_noise_draws) {
  std::vector<SquarePattern> all;
  for (int64_t k = 0; k < depth; ++k) all.push_back(layer(k, from, to, 0, mask));
  return all;
}

double share_of(const SquarePattern& pattern) {
  double count = 0;
  for (const double value : pattern.values) count += value;
  return count / static_cast<double>(pattern.values.size());
}

std::vector<SquarePattern> white_layers(double fraction) {
  std::vector<SquarePattern> all;
  for (int64_t k = 0; k < depth; ++k)
    all.emplace_back(width,
                     [=](int64_t i, int64_t j) { return hashed_draw(row_hash(0, j, k), i) * 0x1p-24 < fraction; });
  return all;
}

}  // namespace

TEST(BlueNoise, EachRankIsThereOnce) {
  for (const uint32_t* mask : masks) {
    std::set<uint32_t> draws;
    for (int64_t k = 0; k < depth; ++k)
      for (int64_t j = 0; j < height; ++j)
        for (int64_t i = 0; i < width; ++i) draws.insert(blue_noise_row(mask, 5, j, k)[i]);
    ASSERT_EQ(static_cast<int64_t>(draws.size()), tile);
    EXPECT_EQ(*draws.begin(), 128U);
    EXPECT_EQ(*draws.rbegin(), (1U << 24) - 128);
  }
}

// Fractions are exact to one voxel; a layer of 4096 voxels cannot do better.
TEST(BlueNoise, LayersKeepFractions) {
  for (const uint32_t* mask : masks)
    for (const double fraction : {1e-5, 0.01, 0.03, 0.1, 1.0 / 3, 0.5, 0.77, 0.999})
      for (int64_t k = 0; k < depth; ++k)
        EXPECT_LT(std::abs(share_of(layer(k, 0, fraction, 3, mask)) - fraction), 1.0 / (width * height)) << fraction;
}

TEST(BlueNoise, VoxelsHaveTheMaskOfTheirShape) {
  const Pitch dpi600{127, 3000}, dpi300{127, 1500}, connex{127, 3000}, tenth{1, 10}, most{14, 100}, more{15, 100};
  EXPECT_EQ(blue_noise_mask(tenth, tenth), blue_noise_draws);
  EXPECT_EQ(blue_noise_mask(dpi600, connex), blue_noise_draws);
  EXPECT_EQ(blue_noise_mask(dpi600, dpi300), blue_noise_long_draws);
  EXPECT_EQ(blue_noise_mask(tenth, most), blue_noise_draws);
  EXPECT_EQ(blue_noise_mask(tenth, more), blue_noise_long_draws);
  // Voxels that are longer along x use the same mask with x and y exchanged.
  const uint32_t* turned = blue_noise_mask(dpi300, dpi600);
  for (size_t n = 0; n < blue_noise_voxels; n += 7) {
    const size_t x = n % 64, y = n / 64 % 64, z = n / 4096;
    ASSERT_EQ(turned[n], blue_noise_long_draws[z * 4096 + x * 64 + y]);
  }
}

// Waves of the same length in millimetres have the same power along x and y, unlike with the mask for square voxels.
TEST(BlueNoise, NoiseOfLongVoxelsIsBlueInMillimetres) {
  for (const double fraction : {0.1, 0.25, 0.5}) {
    const auto x_for_y = [&](const uint32_t* mask) {
      const Spectrum spectrum(layers(0, fraction, mask), fraction);
      return spectrum.mean_along(0, 0.125, 0.25, 2) / spectrum.mean_along(1, 0.125, 0.25, 2);
    };
    EXPECT_NEAR(std::log2(x_for_y(blue_noise_long_draws)), 0, 0.5) << fraction;
    EXPECT_LT(x_for_y(blue_noise_draws), 0.5) << fraction;
  }
}

TEST(BlueNoise, WholeTilesKeepFractions) {
  for (const double fraction : {0.0, 1e-5, 0.1, 1.0 / 3, 0.5, 0.77, 1.0}) {
    double count = 0;
    for (int64_t k = -3; k < depth - 3; ++k)
      for (const double value : layer(k, 0, fraction, 9).values) count += value;
    EXPECT_LE(std::abs(count - fraction * static_cast<double>(tile)), 0.5) << fraction;
  }
}

TEST(BlueNoise, TilesRepeatAlsoBelowZero) {
  for (const auto& [i, j, k] : {std::array<int64_t, 3>{0, 0, 0}, {17, 60, 13}, {11574, 4605, 7407}})
    EXPECT_EQ(draw(i, j, k), draw(i - 3 * width, j - 7 * height, k - 500 * depth));
}

TEST(BlueNoise, SeedsShiftTheMask) {
  // If two patterns of 1/4 of the voxels are independent, they have a share of 1/16 in common. The standard deviation
  // of this share is below 0.004, that of independent voxels.
  for (const uint64_t seed : {uint64_t{1}, uint64_t{2}, uint64_t{1} << 32}) {
    const SquarePattern one = layer(0, 0, 0.25), other = layer(0, 0, 0.25, seed);
    double both = 0;
    for (size_t n = 0; n < one.values.size(); ++n) both += one.values[n] * other.values[n];
    EXPECT_NEAR(both / static_cast<double>(one.values.size()), 1.0 / 16, 4 * 0.004) << seed;
  }
}

TEST(BlueNoise, LayersAreBlue) {
  for (const double fraction : {0.1, 0.25, 0.5, 0.75}) {
    const double white = Spectrum(white_layers(fraction), fraction).low();
    EXPECT_NEAR(white, 1, 0.1);
    for (const uint32_t* mask : masks)
      EXPECT_LT(Spectrum(layers(0, fraction, mask), fraction).low(), 0.1 * white) << fraction;
  }
}

TEST(BlueNoise, EveryMaterialOfAMixtureIsBlue) {
  // The middle one of three materials gets the draws between the other two.
  EXPECT_LT(Spectrum(layers(0.25, 0.5), 0.25).low(), 0.1);
}

TEST(BlueNoise, PatchesKeepFractions) {
  for (const double fraction : {0.1, 0.25, 0.5}) {
    double variance = 0;
    for (const SquarePattern& pattern : layers(0, fraction)) variance += patch_variance(pattern, 16, fraction) / depth;
    EXPECT_LT(variance, 0.125) << fraction;
  }
}

TEST(BlueNoise, VoxelsAboveEachOtherDiffer) {
  // Computes the correlation of a material with itself one layer up. Its lower bound is -f / (1 - f), where it never
  // lies above itself; for white noise it is 0.
  for (const double fraction : {0.1, 0.25, 0.5}) {
    double sum = 0;
    for (int64_t k = 0; k < depth; ++k) {
      const SquarePattern one = layer(k, 0, fraction), above = layer(k + 1, 0, fraction);
      for (size_t n = 0; n < one.values.size(); ++n) sum += (one.values[n] - fraction) * (above.values[n] - fraction);
    }
    const double correlation = sum / static_cast<double>(tile) / (fraction * (1 - fraction));
    EXPECT_LT(correlation, -0.5 * fraction / (1 - fraction)) << fraction;
  }
}

}  // namespace ombre::voxel
