#include "jobs/mesh/mixed_filaments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace ombre::jobs {
namespace {

// The layers of two filaments that PrusaSlicer 2.9.6 makes of a ratio: the shortest cycle of at least two layers in
// which no share is off by more than 3 %.
std::pair<int, int> cycle_of_prusa_slicer(int first, int second) {
  const double sum = first + second;
  for (int layers = 2;; ++layers) {
    const int a = std::max(1, static_cast<int>(std::lround(first / sum * layers)));
    const int b = std::max(1, static_cast<int>(std::lround(second / sum * layers)));
    if (std::abs(first / sum - static_cast<double>(a) / (a + b)) > 0.03) continue;
    const int common = std::gcd(a, b);
    return {a / common, b / common};
  }
}

TEST(LayerCycles, AreKeptByPrusaSlicer) {
  for (int layers = 2; layers <= longest_cycle; ++layers)
    for (int first = 1; first < layers; ++first) {
      if (std::gcd(first, layers) > 1) continue;
      EXPECT_EQ(cycle_of_prusa_slicer(first, layers - first), std::pair(first, layers - first));
    }
  // A longer cycle would become another one.
  EXPECT_NE(cycle_of_prusa_slicer(3, 4), std::pair(3, 4));
}

TEST(LayerCycles, AreTheNearest) {
  const auto is = [](double share, int most, int first, int layers) {
    const LayerCycle cycle = nearest_cycle(share, most);
    EXPECT_EQ(cycle.first, first) << share;
    EXPECT_EQ(cycle.layers, layers) << share;
  };
  is(0.125, 4, 0, 1);
  is(0.2, 4, 1, 4);
  is(0.375, 4, 1, 3);
  is(0.375, 6, 2, 5);
  is(0.5, 6, 1, 2);
  is(0.95, 6, 1, 1);
  for (double share = 0; share <= 1; share += 0.01)
    EXPECT_LE(std::abs(nearest_cycle(share, 6).share() - share), 1.0 / 12 + 1e-12) << share;
}

}  // namespace
}  // namespace ombre::jobs
