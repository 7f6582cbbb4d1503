#include "base/math/interval.h"

#include <gtest/gtest.h>

namespace ombre {

TEST(Interval, OutwardEnclosesWhatItRounds) {
  const Interval i = outward(0.1, 0.3);
  EXPECT_LT(i.lo, 0.1);
  EXPECT_GT(i.hi, 0.3);
  EXPECT_TRUE(outward(std::nan(""), 1).is_everything());
}

}  // namespace ombre
