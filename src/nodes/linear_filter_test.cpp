#include "nodes/common/linear_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ombre::nodes {
namespace {

NumberGrid random_grid(std::array<int64_t, 3> size) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(0, 1);
  NumberGrid grid{size, {}};
  for (int64_t n = size[0] * size[1] * size[2]; n > 0; --n) grid.values.push_back(value(random));
  return grid;
}

TEST(LinearFilter, ReadsSoManyVoxelsBelowAndAbove) {
  const LinearFilter filter = LinearFilter::of({{10, 3, 1}, std::vector<double>(30, 1.0)});
  EXPECT_EQ(filter.below(), (std::array<int64_t, 3>{5, 1, 0}));
  EXPECT_EQ(filter.above(), (std::array<int64_t, 3>{4, 1, 0}));
}

// A kernel that is nearly a product is summed as a whole, and must give nearly the same result.
TEST(LinearFilter, OfAProductIsTheSumOfItsProducts) {
  design::Kernel kernel{{2, 3, 2}, {}};
  const double a[] = {1, 2}, b[] = {3, 1, 2}, c[] = {1, 4};
  for (const double x : a)
    for (const double y : b)
      for (const double z : c) kernel.weights.push_back(x * y * z);
  design::Kernel other = kernel;
  other.weights[0] *= 1 + 1e-9;
  const NumberGrid grid = random_grid({5, 6, 4});
  const NumberGrid product = LinearFilter::of(kernel).apply(grid), whole = LinearFilter::of(other).apply(grid);
  ASSERT_EQ(product.size, (std::array<int64_t, 3>{4, 4, 3}));
  ASSERT_EQ(product.values.size(), whole.values.size());
  for (size_t n = 0; n < whole.values.size(); ++n) EXPECT_NEAR(product.values[n], whole.values[n], 1e-8);
}

// A step blurred by a normal distribution is the error function. The sum over voxels differs from the integral by at
// most 1/24 of the greatest slope of the distribution, 0.242 / sigma^2.
TEST(LinearFilter, BlursAStepToTheErrorFunction) {
  constexpr double sigma = 3;
  const LinearFilter filter = LinearFilter::gaussian({sigma, 0, 0});
  const int64_t reach = filter.below()[0], width = 60;
  EXPECT_EQ(reach, 12);
  NumberGrid step{{width, 1, 1}, std::vector<double>(static_cast<size_t>(width), 0.0)};
  for (int64_t i = width / 2; i < width; ++i) step.values[static_cast<size_t>(i)] = 1;
  const NumberGrid blurred = filter.apply(step);
  for (size_t n = 0; n < blurred.values.size(); ++n) {
    // The border lies between two voxels.
    const double from_border =
        static_cast<double>(n) + static_cast<double>(reach) + 0.5 - static_cast<double>(width) / 2;
    EXPECT_NEAR(blurred.values[n], 0.5 * (1 + std::erf(from_border / (sigma * std::sqrt(2.0)))),
                0.242 / (24 * sigma * sigma) + 1e-4)
        << n;
  }
}

TEST(LinearFilter, RangesHoldWhatSharpeningGives) {
  const LinearFilter filter = LinearFilter::gaussian({1, 0.5, 0.7}).sharpened(2);
  const Interval range = filter.range();
  EXPECT_LT(range.lo, -1);
  for (const double value : filter.apply(random_grid({12, 10, 9})).values) EXPECT_TRUE(range.contains(value)) << value;
}

}  // namespace
}  // namespace ombre::nodes
