#include "questions/region_request.h"

#include <gtest/gtest.h>

namespace ombre::compile {
namespace {

// An interval of width w takes w / (2 d) bands of width 2 d, rounded up.
TEST(Bands, AreAsFewAsTheDistanceTakes) {
  EXPECT_EQ(fewest_bands({0, 10}, 2.5), 2);
  EXPECT_EQ(fewest_bands({0, 10}, 2.4), 3);
  EXPECT_EQ(fewest_bands({0, 10}, 5), 1);
  EXPECT_EQ(fewest_bands({0, 1}, 0.1), 5);
  EXPECT_EQ(fewest_bands({3, 3}, 0.1), 1);
}

}  // namespace
}  // namespace ombre::compile
