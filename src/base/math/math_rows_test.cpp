// Compares rows of numbers with math.h bit by bit, for every instruction set of this processor.
#include "base/math/math_rows.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "base/math/math.h"

namespace ombre::math {
namespace {

std::vector<double> numbers() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<double> all{0.0,
                          -0.0,
                          1,
                          -1,
                          inf,
                          -inf,
                          std::nan(""),
                          std::numeric_limits<double>::denorm_min(),
                          std::numeric_limits<double>::min(),
                          std::numeric_limits<double>::max()};
  std::mt19937_64 random(5);
  for (int n = 0; n < 100000; ++n) {
    all.push_back(std::bit_cast<double>(random()));  // any magnitude, including infinities and NaN
    all.push_back(std::uniform_real_distribution(-20.0, 20.0)(random));
    all.push_back(std::uniform_real_distribution(-1.0, 1.0)(random));
    all.push_back(std::uniform_real_distribution(-1e6, 1e6)(random));
  }
  return all;
}

void expect_equal_bits(RowFunction row, double (*one)(double), const char* name) {
  static const std::vector<double> all = numbers();
  std::vector<double> out(all.size());
  row(all.data(), out.data(), all.size());
  for (size_t n = 0; n < all.size(); ++n) {
    const double expected = one(all[n]);
    if (std::isnan(expected))
      ASSERT_TRUE(std::isnan(out[n])) << name << " of " << all[n];
    else
      ASSERT_EQ(std::bit_cast<uint64_t>(out[n]), std::bit_cast<uint64_t>(expected)) << name << " of " << all[n];
  }
}

}  // namespace

TEST(MathRows, HaveTheBitsOfSingleNumbers) {
  for (const RowFunctions& functions : row_functions()) {
#define OMBRE_ROW_FUNCTION(name) \
  expect_equal_bits(             \
      functions.name, [](double v) { return math::name(v); }, #name);
    OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)
#undef OMBRE_ROW_FUNCTION
  }
}

TEST(MathRows, TakeAnyNumberOfThem) {
  const std::vector<double> in{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7};
  for (const RowFunctions& functions : row_functions()) {
    for (size_t count = 0; count <= in.size(); ++count) {
      std::vector<double> out = in;
      functions.sin(out.data(), out.data(), count);
      for (size_t n = 0; n < in.size(); ++n) ASSERT_EQ(out[n], n < count ? math::sin(in[n]) : in[n]);
    }
  }
}

}  // namespace ombre::math
