// Compares symbolic derivatives with finite differences and with derivatives computed by hand.
#include "program/gradient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "program/test_evaluation.h"

namespace ombre::program {
namespace {

using Formula = std::function<Field(const Point&)>;

// Returns a point that is an affine image of the program's inputs.
Point turned(Builder& builder) {
  Affine map = Affine::scaling({0.5, 2, 1.5});
  map.offset = {0.25, -1, 2};
  return Point::origin_frame(builder).mapped(map);
}

// A formula at the inputs, and its gradient.
struct Both {
  Program value, slopes;
};

std::optional<Both> make(const Formula& formula) {
  Builder builder;
  const Point p = Point::origin_frame(builder);
  const Field of = formula(p);
  const auto by = gradient(of, p);
  if (!by) return std::nullopt;
  return Both{builder.finish({{"value", of}}), builder.finish({{"x", (*by)[0]}, {"y", (*by)[1]}, {"z", (*by)[2]}})};
}

Formula unary(Op op, double scale = 1, double shift = 0) {
  return [=](const Point& p) { return p.builder().apply(op, (p.x * p.y + p.z) * scale + shift); };
}

Formula binary(Op op) {
  return [=](const Point& p) { return p.builder().apply(op, p.x * p.y, p.z + 3.0); };
}

}  // namespace

TEST(Gradient, FollowsDifferences) {
  std::vector<Formula> formulas{
      unary(Op::negate),
      unary(Op::abs),
      unary(Op::square),
      unary(Op::sqrt, 0.1, 2),
      unary(Op::sin),
      unary(Op::cos),
      unary(Op::tan, 0.1),
      unary(Op::asin, 0.1),
      unary(Op::acos, 0.1),
      unary(Op::atan),
      unary(Op::sinh, 0.2),
      unary(Op::cosh, 0.2),
      unary(Op::tanh),
      unary(Op::exp, 0.2),
      unary(Op::log, 0.1, 2),
      unary(Op::log10, 0.1, 2),
      unary(Op::log2, 0.1, 2),
      unary(Op::floor),
      unary(Op::truth),
      binary(Op::add),
      binary(Op::subtract),
      binary(Op::multiply),
      binary(Op::divide),
      binary(Op::min),
      binary(Op::max),
      binary(Op::atan2),
      binary(Op::less),
      [](const Point& p) { return select(less(p.x, p.y), p.x * p.z, square(p.y)); },
      [](const Point& p) { return p.builder().apply(Op::fma, p.x, p.y, p.z); },
      [](const Point& p) { return p.builder().apply(Op::mod, p.x + 9.0, p.constant(2)); },
      [](const Point& p) { return p.builder().apply(Op::pow, square(p.x) + 1, p.constant(1.5)); },
      [](const Point& p) { return power(p.x + p.y, p.constant(3)); },
      [](const Point& p) { return length(p.x, p.y, p.z); },
      [](const Point& p) {
        return p.builder().affine({0.5, -2, 3, 4}, p.x, p.y, p.z) * p.x;
      },
      [](const Point& p) { return p.constant(7); },
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  for (size_t n = 0; n < formulas.size(); ++n) {
    const auto made = make(formulas[n]);
    ASSERT_TRUE(made) << n;
    for (int round = 0; round < 200; ++round) {
      const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-5;
        Vec3 by;
        by[axis] = step;
        const double up = value_at(made->value, p + by), down = value_at(made->value, p - by),
                     here = value_at(made->value, p);
        // Skips kinks and jumps.
        if (std::abs((up - here) - (here - down)) > 1e-7) continue;
        const double slope = (up - down) / (2 * step);
        EXPECT_NEAR(value_at(made->slopes, p, static_cast<size_t>(axis)), slope, 1e-5 * (1 + std::abs(slope)))
            << "formula " << n << " at " << p.x << " " << p.y << " " << p.z << " along axis " << axis;
      }
    }
  }
}

// Derivatives are by the point's own coordinates, however it was made.
TEST(Gradient, IsByThePointsCoordinates) {
  Builder builder;
  const Point p = turned(builder);
  const auto by = gradient(p.x * p.y + square(p.z), p);
  ASSERT_TRUE(by);
  const Program program = builder.finish({{"x", (*by)[0]}, {"y", (*by)[1]}, {"z", (*by)[2]}});
  const Vec3 q{0.5 * 4 + 0.25, 2 * 3 - 1.0, 1.5 * 2 + 2};
  EXPECT_DOUBLE_EQ(value_at(program, {4, 3, 2}, 0), q.y);
  EXPECT_DOUBLE_EQ(value_at(program, {4, 3, 2}, 1), q.x);
  EXPECT_DOUBLE_EQ(value_at(program, {4, 3, 2}, 2), 2 * q.z);
}

// The distance from an axis has no derivative on the axis; the result there must stay finite.
TEST(Gradient, IsZeroWhereRootsAndAnglesHaveNone) {
  const auto root = make([](const Point& p) { return length(p.x, p.y); });
  const auto angle = make([](const Point& p) { return p.builder().apply(Op::atan2, p.y, p.x); });
  for (const auto& made : {root, angle})
    for (size_t n = 0; n < 3; ++n) EXPECT_EQ(value_at(made->slopes, {0, 0, 1}, n), 0);
}

TEST(Gradient, HasNoRuleForSomeThings) {
  EXPECT_FALSE(make([](const Point& p) { return p.builder().apply(Op::pow, square(p.x), p.y); }));
  EXPECT_FALSE(make([](const Point& p) { return p.builder().apply(Op::mod, p.x, p.y); }));
  // This field depends on space in another way than through the point.
  Builder builder;
  const Point p = turned(builder);
  EXPECT_FALSE(gradient(p.x * builder.input(0), p));
}

}  // namespace ombre::program
