// Compares elementary functions with long double libm, which has eleven more bits.
#include "base/math/math.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace ombre {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Unary = double (*)(double);
using Exact = long double (*)(long double);

struct Function {
  std::string name;
  Unary ours;
  Exact exact;
  double lo, hi;
};

// Returns the error in units in the last place of the true value.
double error_ulp(double value, long double truth) {
  const auto nearest = static_cast<double>(truth);
  if (std::isinf(nearest) || nearest == 0) return value == nearest ? 0 : 1e9;
  const double ulp = std::nextafter(std::abs(nearest), inf) - std::abs(nearest);
  return static_cast<double>(std::abs(static_cast<long double>(value) - truth) / ulp);
}

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

}  // namespace

TEST(Math, WithinOneUnitInTheLastPlace) {
  const Function functions[] = {
      {"sin", math::sin, sinl, -100, 100},  {"sin", math::sin, sinl, -1e8, 1e8},
      {"cos", math::cos, cosl, -100, 100},  {"cos", math::cos, cosl, -1e8, 1e8},
      {"tan", math::tan, tanl, -100, 100},  {"asin", math::asin, asinl, -1, 1},
      {"acos", math::acos, acosl, -1, 1},   {"atan", math::atan, atanl, -1e3, 1e3},
      {"sinh", math::sinh, sinhl, -20, 20}, {"cosh", math::cosh, coshl, -20, 20},
      {"tanh", math::tanh, tanhl, -20, 20}, {"exp", math::exp, expl, -700, 700},
      {"exp", math::exp, expl, -1, 1},      {"log", math::log, logl, 1e-3, 3},
      {"log", math::log, logl, 0, 1e10},    {"log10", math::log10, log10l, 0, 1e10},
      {"log2", math::log2, log2l, 0, 1e10},
  };
  for (const Function& f : functions) {
    std::mt19937_64 random(29);
    std::uniform_real_distribution<double> any(f.lo, f.hi);
    double worst = 0, where = 0;
    for (int i = 0; i < 20000; ++i) {
      const double v = any(random);
      const double error = error_ulp(f.ours(v), f.exact(v));
      if (error > worst) worst = error, where = v;
    }
    EXPECT_LE(worst, 1) << f.name << '(' << where << ')';
  }
}

TEST(Math, PowersWithinOneUnitInTheLastPlace) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> base(0, 50), exponent(-40, 40), side(-10, 10);
  for (int i = 0; i < 20000; ++i) {
    const double b = base(random), e = exponent(random), y = side(random), x = side(random);
    EXPECT_LE(error_ulp(math::pow(b, e), powl(b, e)), 1) << b << '^' << e;
    EXPECT_LE(error_ulp(math::atan2(y, x), atan2l(y, x)), 1) << y << ", " << x;
    const double whole = std::floor(e);
    EXPECT_LE(error_ulp(math::pow(-b, whole), powl(-b, whole)), 1) << -b << '^' << whole;
  }
}

TEST(Math, SpecialValues) {
  struct {
    std::string name;
    double value, expected;
  } const cases[] = {
      {"sin -0", math::sin(-0.0), -0.0},
      {"sin inf", math::sin(inf), nan},
      {"cos 0", math::cos(0), 1},
      {"cos -inf", math::cos(-inf), nan},
      {"tan -0", math::tan(-0.0), -0.0},
      {"asin 2", math::asin(2), nan},
      {"acos 1", math::acos(1), 0},
      {"acos -2", math::acos(-2), nan},
      {"atan -0", math::atan(-0.0), -0.0},
      {"atan2 0 0", math::atan2(0, 0), 0},
      {"atan2 -0 1", math::atan2(-0.0, 1), -0.0},
      {"tanh inf", math::tanh(inf), 1},
      {"tanh -inf", math::tanh(-inf), -1},
      {"sinh 1000", math::sinh(1000), inf},
      {"cosh -1000", math::cosh(-1000), inf},
      {"exp 0", math::exp(0), 1},
      {"exp -inf", math::exp(-inf), 0},
      {"exp inf", math::exp(inf), inf},
      {"exp 1000", math::exp(1000), inf},
      {"exp -1000", math::exp(-1000), 0},
      {"log 1", math::log(1), 0},
      {"log 0", math::log(0), -inf},
      {"log -0", math::log(-0.0), -inf},
      {"log -1", math::log(-1), nan},
      {"log inf", math::log(inf), inf},
      {"log10 1000", math::log10(1000), 3},
      {"log2 1024", math::log2(1024), 10},
      {"pow 0 0", math::pow(0, 0), 1},
      {"pow nan 0", math::pow(nan, 0), 1},
      {"pow 1 nan", math::pow(1, nan), 1},
      {"pow -8 3", math::pow(-8, 3), -512},
      {"pow -8 1/3", math::pow(-8, 1.0 / 3), nan},
      {"pow 0 -1", math::pow(0, -1), inf},
      {"pow -0 -1", math::pow(-0.0, -1), -inf},
      {"pow 2 -1074", math::pow(2, -1074), 5e-324},
      {"pow 2 1024", math::pow(2, 1024), inf},
      {"pow inf -1", math::pow(inf, -1), 0},
      {"mod 5.5 2", math::mod(5.5, 2), 1.5},
      {"mod -5.5 2", math::mod(-5.5, 2), -1.5},
      {"mod 1 0", math::mod(1, 0), nan},
      {"round 2.5", math::round(2.5), 3},
      {"round -2.5", math::round(-2.5), -3},
      {"sqrt -1", math::sqrt(-1), nan},
  };
  for (const auto& c : cases) EXPECT_TRUE(same(c.value, c.expected)) << c.name << " is " << c.value;
  for (const Unary f : {Unary{math::sin}, Unary{math::cos}, Unary{math::tan}, Unary{math::asin}, Unary{math::acos},
                        Unary{math::atan}, Unary{math::sinh}, Unary{math::cosh}, Unary{math::tanh}, Unary{math::exp},
                        Unary{math::log}, Unary{math::log10}, Unary{math::log2}})
    EXPECT_TRUE(std::isnan(f(nan)));
}

TEST(Math, ValuesThatAreNotNumbersLose) {
  EXPECT_EQ(math::min(nan, 1), 1);
  EXPECT_EQ(math::min(1, nan), 1);
  EXPECT_EQ(math::max(nan, 1), 1);
  EXPECT_EQ(math::max(1, nan), 1);
  EXPECT_TRUE(std::isnan(math::max(nan, nan)));
  EXPECT_EQ(math::min(-inf, inf), -inf);
}

TEST(Math, ComparisonsAndLogic) {
  EXPECT_EQ(math::less(1, 2), 1);
  EXPECT_EQ(math::less(2, 2), 0);
  EXPECT_EQ(math::less_equal(2, 2), 1);
  EXPECT_EQ(math::equal(0.0, -0.0), 1);
  EXPECT_EQ(math::less(nan, nan), 0);
  EXPECT_EQ(math::less_equal(nan, nan), 0);
  EXPECT_EQ(math::equal(nan, nan), 0);
  EXPECT_EQ(math::truth(nan), 1);  // NaN is not zero, so it counts as true
  EXPECT_EQ(math::logical_and(2, -1), 1);
  EXPECT_EQ(math::logical_or(0, 0), 0);
  EXPECT_EQ(math::logical_not(0.5), 0);
  EXPECT_EQ(math::select(1, 2, 3), 2);
  EXPECT_EQ(math::select(0, 2, 3), 3);
  EXPECT_EQ(math::is_finite(inf), 0);
  EXPECT_EQ(math::is_finite(nan), 0);
  EXPECT_EQ(math::is_finite(1e308), 1);
}

}  // namespace ombre
