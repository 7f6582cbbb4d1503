#include "base/math/round_numbers.h"

#include <gtest/gtest.h>

#include <vector>

namespace ombre::math {
namespace {

struct Case {
  double value, below, above;
};

TEST(RoundNumbers, AreTheNearestOnBothSides) {
  for (const Case& c : std::vector<Case>{{1, 1, 1},
                                         {1.99, 1, 2},
                                         {2, 2, 2},
                                         {4.9, 2, 5},
                                         {5, 5, 5},
                                         {9.99, 5, 10},
                                         {10, 10, 10},
                                         {777, 500, 1000},
                                         {0.3, 0.2, 0.5},
                                         {0.099, 0.05, 0.1}}) {
    EXPECT_NEAR(greatest_round(c.value), c.below, 1e-12 * c.below) << c.value;
    EXPECT_NEAR(least_round(c.value), c.above, 1e-12 * c.above) << c.value;
  }
}

}  // namespace
}  // namespace ombre::math
