#include "voxel/quantise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace ombre::voxel {
namespace {

double hashed(uint64_t seed, int64_t i, int64_t j, int64_t k) { return hashed_draw(row_hash(seed, j, k), i) * 0x1p-24; }

// Returns the correlation of draws at voxels that differ by the given step, over a block of 100^3 voxels.
double correlation(std::array<int64_t, 3> step, uint64_t seed, uint64_t other_seed) {
  constexpr int64_t n = 100;
  double sum = 0;
  for (int64_t k = 0; k < n; ++k)
    for (int64_t j = 0; j < n; ++j)
      for (int64_t i = 0; i < n; ++i)
        sum += (hashed(seed, i, j, k) - 0.5) * (hashed(other_seed, i + step[0], j + step[1], k + step[2]) - 0.5);
  return sum / (n * n * n) * 12;  // the variance of a uniform draw is 1/12
}

constexpr double four_sigma = 4e-3;  // four standard deviations for 10^6 pairs

}  // namespace

TEST(Quantise, DrawsAreUniform) {
  // Chi-squared over 256 bins of 10^6 draws has mean 255 and standard deviation sqrt(2 * 255) = 22.6.
  for (const uint64_t seed : {uint64_t{0}, uint64_t{1}, uint64_t{0xDEADBEEF12345678}}) {
    std::array<int, 256> bins{};
    for (int64_t k = 0; k < 100; ++k)
      for (int64_t j = 0; j < 100; ++j)
        for (int64_t i = 0; i < 100; ++i) ++bins[static_cast<size_t>(hashed(seed, i, j, k) * 256)];
    double chi = 0;
    for (const int count : bins) chi += std::pow(count - 1e6 / 256, 2) / (1e6 / 256);
    EXPECT_NEAR(chi, 255, 4 * 22.6) << seed;
  }
}

TEST(Quantise, NeighboursAndSeedsAreUncorrelated) {
  for (const std::array<int64_t, 3> step : {std::array<int64_t, 3>{1, 0, 0},
                                            {2, 0, 0},
                                            {0, 1, 0},
                                            {0, 0, 1},
                                            {1, 1, 0},
                                            {0, 1, 1},
                                            {1, 1, 1},
                                            {-1, 1, 0},
                                            {0, 64, 0},
                                            {256, 0, 0}})
    EXPECT_LT(std::abs(correlation(step, 7, 7)), four_sigma) << step[0] << step[1] << step[2];
  EXPECT_LT(std::abs(correlation({0, 0, 0}, 0, 1)), four_sigma);
  EXPECT_LT(std::abs(correlation({0, 0, 0}, 5, uint64_t{5} << 32)), four_sigma);
}

TEST(Quantise, NegativeAndLargeIndicesDiffer) {
  EXPECT_NE(hashed(0, 0, 0, 0), hashed(0, 0, 0, 1));
  EXPECT_NE(hashed(0, 11574, 4605, 7407), hashed(0, 11575, 4605, 7407));
}

TEST(Quantise, TheFirstThresholdAboveTheDrawDecides) {
  const std::array<double, 2> thresholds{0.2, 0.2};  // fractions 0.2, 0, 0.8
  EXPECT_EQ(first_above<double>(thresholds, 0.0), 0u);
  EXPECT_EQ(first_above<double>(thresholds, 0.1999), 0u);
  EXPECT_EQ(first_above<double>(thresholds, 0.2), 2u);
  EXPECT_EQ(first_above<double>(thresholds, 1 - 0x1p-24), 2u);
}

}  // namespace ombre::voxel
