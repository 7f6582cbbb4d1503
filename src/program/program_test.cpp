// Tests of builders, passes and intervals.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "program/field.h"
#include "program/passes/passes.h"
#include "program/program_text.h"
#include "program/test_evaluation.h"

namespace ombre::program {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

}  // namespace

TEST(Builder, SharesEqualExpressionsAndFoldsConstants) {
  Builder b;
  const Field x = b.input(0), y = b.input(1);
  EXPECT_EQ((x + y).id, (x + y).id);
  EXPECT_NE((x + y).id, (y + x).id);
  EXPECT_EQ(b.constant_value(sqrt(b.constant(9)) + b.constant(1)), 4.0);
  EXPECT_EQ((x * 1.0).id, x.id);
  EXPECT_EQ(select(b.constant(1), x, y).id, x.id);
  EXPECT_EQ(logical_not(logical_not(x <= 0)).id, (x <= 0).id);
  EXPECT_EQ(b.finish({{"v", x + y}}).code.size(), 3u);
}

TEST(Builder, SharesAmongThousandsAndStartsAnew) {
  Builder b;
  for (int round = 0; round < 2; ++round) {
    std::vector<Field> sums;
    for (int n = 1; n <= 3000; ++n) sums.push_back(b.input(0) + n);
    EXPECT_EQ(b.size(), 3u + 2 * 3000u);
    for (int n = 1; n <= 3000; ++n) EXPECT_EQ((b.input(0) + n).id, sums[static_cast<size_t>(n) - 1].id);
    EXPECT_EQ(value_at(b.finish({{"v", sums[41]}}), {1, 0, 0}), 43);
    b.clear();
    EXPECT_EQ(b.size(), 3u);
  }
}

TEST(Builder, DoesNotFoldWhatInfinitiesWouldBreak) {
  Builder b;
  const Field x = b.input(0);
  EXPECT_TRUE(std::isnan(value_at(b.finish({{"v", x * 0.0}}), {inf, 0, 0})));
  EXPECT_TRUE(std::isnan(value_at(b.finish({{"v", x - x}}), {inf, 0, 0})));
}

TEST(Builder, IntegerPowersAreProducts) {
  Builder b;
  const Field x = b.input(0);
  EXPECT_EQ(value_at(b.finish({{"v", power(x, b.constant(3))}}), {-2, 0, 0}), -8);
  EXPECT_EQ(value_at(b.finish({{"v", power(x, b.constant(10))}}), {2, 0, 0}), 1024);
  EXPECT_EQ(value_at(b.finish({{"v", power(x, b.constant(-2))}}), {4, 0, 0}), 1.0 / 16);
  EXPECT_EQ(value_at(b.finish({{"v", power(x, b.constant(0))}}), {0, 0, 0}), 1);
}

TEST(Points, ComposeAffineMapsExactly) {
  Builder b;
  const Point p = Point::origin_frame(b);
  EXPECT_EQ(p.mapped(Affine::translation({1, 2, 3})).mapped(Affine::translation({-1, -2, -3})).x.id, p.x.id);
  const Point turned = p.mapped(Affine::rotation({0, 0, 1}, 90));
  EXPECT_EQ(turned.y.id, p.x.id);
}

TEST(Intervals, HoldEveryOpOnRandomAndOddValues) {
  std::mt19937 random(1);
  const double odd[] = {0.0, -0.0, 1, -1, inf, -inf, std::nan(""), 1e300, -1e300, 1e-310, 0.5, 2, 3.14159265358979,
                        1e9};
  const auto pick = [&]() -> double {
    if (random() % 3 == 0) return odd[random() % std::size(odd)];
    return std::uniform_real_distribution<double>(-8, 8)(random);
  };
  const auto around = [&](double a, double b) {
    if (std::isnan(a) || std::isnan(b)) return Interval::everything();
    return Interval(std::min(a, b), std::max(a, b));
  };
#define OMBRE_ROW(name, arity)                                                                                      \
  for (int n = 0; n < 20000; ++n) {                                                                                 \
    const double a = pick(), b = pick(), c = pick();                                                                \
    const Interval ia = around(a, pick()), ib = around(b, pick()), ic = around(c, pick());                          \
    const double v = apply(Op::name, a, b, c);                                                                      \
    const Interval i = apply(Op::name, ia, ib, ic);                                                                 \
    ASSERT_TRUE(i.contains(v)) << #name << "(" << a << ", " << b << ", " << c << ") = " << v << " not in [" << i.lo \
                               << ", " << i.hi << "]";                                                              \
  }
  OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
}

TEST(Intervals, AreTightWhereItMatters) {
  EXPECT_EQ(math::square(Interval(-2, 1)).lo, 0);
  EXPECT_EQ(math::sin(Interval(1, 2)).hi, 1);
  EXPECT_LT(math::sin(Interval(0, 1)).hi, 0.85);
  EXPECT_EQ(math::mod(Interval(5, 5.5), 4), Interval(1, 1.5));
  EXPECT_LT(math::atan2(Interval(1, 2), Interval(1, 2)).hi, 1.2);
}

TEST(Shorten, KeepsOnlyWhatCanWin) {
  Builder b;
  const Field x = b.input(0), y = b.input(1);
  const Program program = b.finish({{"v", min(x, select(y <= 0, square(y), b.constant(100)))}});
  std::vector<Interval> values;
  evaluate_intervals(program, {{0, 1, 0}, {1, 2, 1}}, values);
  EXPECT_EQ(shorten(program, values).code.size(), 1u);
}

TEST(Shorten, MakesRepeatsOfWhatIsAbsentOne) {
  Builder b;
  const Field x = b.input(0), absent = max(x - 10, b.constant(0)), all = square(x) + 1;
  const Program program = b.finish({{"one", share(x, all)}, {"two", share(x + absent, all)}});
  std::vector<Interval> values;
  evaluate_intervals(program, {{1, 0, 0}, {2, 0, 0}}, values);
  const Program shorter = shorten(program, values);
  EXPECT_EQ(shorter.outputs[0], shorter.outputs[1]);
}

TEST(Shorten, TakesSidesOfExtremesThatTouchTheOther) {
  Builder b;
  const Field x = b.input(0), zero = b.constant(0);
  const Program program = b.finish({{"v", max(square(x), zero) + min(zero, square(x)) + 1}});
  std::vector<Interval> values;
  evaluate_intervals(program, {{-1, 0, 0}, {1, 0, 0}}, values);
  const std::string text = to_text(shorten(program, values));
  EXPECT_EQ(text.find("max"), std::string::npos) << text;
  EXPECT_EQ(text.find("min"), std::string::npos) << text;
}

TEST(InlineBodies, KeepsTheMeaning) {
  auto body = std::make_shared<Program>();
  Builder inner;
  *body = inner.finish({{"g", length(inner.input(0), inner.input(1))}});
  Builder b;
  const Field f =
      b.call(body, 0, b.input(0), b.input(1), b.input(2)) + b.call(body, 0, b.input(1), b.constant(3), b.input(2));
  const Program program = b.finish({{"v", f}});
  EXPECT_EQ(inlined_size(program), static_cast<double>(program.code.size() + 2 * body->code.size()));
  EXPECT_EQ(value_at(inline_bodies(program), {3, 4, 0}), 10);
  EXPECT_NE(to_text(program).find("call body0.g"), std::string::npos);
}

TEST(AffineOperands, SeeThroughNestedMaps) {
  Builder b;
  const Point p = Point::origin_frame(b).mapped(Affine::rotation({1, 2, 3}, 40)).mapped(Affine::scaling({1, -2, 3}));
  const Program program = b.finish({{"v", select(p.x, p.y, p.z)}});
  const auto map = affine_operands(program, program.code[program.outputs[0]]);
  ASSERT_TRUE(map);
  const Vec3 expected = (Affine::scaling({1, -2, 3}) * Affine::rotation({1, 2, 3}, 40))({1, 5, 7}),
             found = (*map)({1, 5, 7});
  EXPECT_NEAR(length(expected - found), 0, 1e-12);
  const Program curved = b.finish({{"v", select(square(p.x), p.y, p.z)}});
  EXPECT_FALSE(affine_operands(curved, curved.code[curved.outputs[0]]));
}

TEST(ComposeAffine, TurnedFramesKnowTheirRanges) {
  Builder b;
  const Field x = b.input(0), y = b.input(1);
  const double half = std::sqrt(0.5);
  const Field right = half * (x + y), up = half * (y - x);                 // turned by 45 degrees
  const Program program = b.finish({{"v", square(half * (right - up))}});  // turned back
  const Program composed = compose_affine(program);
  const Box box{{-1, -2, -3}, {1, 2, 3}};
  std::vector<Interval> values;
  evaluate_intervals(composed, box, values);
  EXPECT_NEAR(values[composed.outputs[0]].hi, 1, 1e-9);
  evaluate_intervals(program, box, values);
  EXPECT_GT(values[program.outputs[0]].hi, 8.9);
  for (const Vec3 p : {Vec3{1, 5, 7}, Vec3{-0.3, 0, 2}, Vec3{0, 0, 0}})
    EXPECT_NEAR(value_at(composed, p), value_at(program, p), 1e-12);
}

TEST(ComposeAffine, LeavesWhatIsNotAffine) {
  Builder b;
  const Field x = b.input(0), y = b.input(1);
  const Program program = b.finish({{"product", x * y}, {"ratio", (x + y) / (x + 1)}, {"constant", x - x}});
  const Program composed = compose_affine(program);
  for (size_t n = 0; n < program.outputs.size(); ++n)
    EXPECT_EQ(value_at(composed, {2, 3, 0}, n), value_at(program, {2, 3, 0}, n)) << program.output_names[n];
}

}  // namespace ombre::program
