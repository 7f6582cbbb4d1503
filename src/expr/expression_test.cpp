#include "expr/expression.h"

#include "program/test_evaluation.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ombre::expr {
namespace {

using std::numbers::e;
using std::numbers::pi;

SourceRange place_of(const std::string& text) {
  return {make_source("part.vcad", "f(\"" + text + "\")"), 3, static_cast<uint32_t>(3 + text.size())};
}

std::optional<Expression> parse(const std::string& text, Diagnostics& diagnostics) {
  return Expression::parse(text, place_of(text), diagnostics);
}

double value(const std::string& text, Vec3 p = {0, 0, 0}) {
  Diagnostics diagnostics;
  const auto expression = parse(text, diagnostics);
  EXPECT_TRUE(expression) << to_text(diagnostics);
  if (!expression) return std::nan("");
  program::Builder builder;
  const auto field = expression->lower(program::Point::origin_frame(builder), nullptr);
  return program::value_at(builder.finish({{"v", field}}), p);
}

std::string message(const std::string& text) {
  Diagnostics diagnostics;
  const auto expression = parse(text, diagnostics);
  if (expression) expression->check_variables(coordinate_names(), text, place_of(text), diagnostics);
  return to_text(diagnostics);
}

}  // namespace

TEST(Expression, Precedence) {
  EXPECT_EQ(value("1 + 2 * 3"), 7);
  EXPECT_EQ(value("-x^2", {3, 0, 0}), -9);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("(2^3)^2"), 64);
  EXPECT_EQ(value("8 / 4 / 2"), 1);
  EXPECT_EQ(value("8 - 4 - 2"), 2);
  EXPECT_EQ(value("7 % 4"), 3);
  EXPECT_EQ(value("-7 % 4"), -3);
  EXPECT_EQ(value("1 < 2 and 2 < 1 or 1"), 1);
  EXPECT_EQ(value("1 ? 2 : 0 ? 3 : 4"), 2);
  EXPECT_EQ(value("0 ? 2 : 0 ? 3 : 4"), 4);
  EXPECT_EQ(value("not 1 + 1"), 1);
}

TEST(Expression, AFormulaIsParsedOnceButItsErrorsAreReportedWhereverItStands) {
  Diagnostics diagnostics;
  const auto first = parse("x + 1", diagnostics), again = parse("x + 1", diagnostics),
             other = parse("x+ 1", diagnostics);
  EXPECT_EQ(&first->text(), &again->text());
  EXPECT_NE(&first->text(), &other->text());
  EXPECT_TRUE(*first == *other);
  EXPECT_FALSE(*first == *parse("x + 2", diagnostics));
  EXPECT_EQ(message("x + q"), message("x + q"));
  EXPECT_NE(message("x + q").find("part.vcad:1:8"), std::string::npos) << message("x + q");
  EXPECT_EQ(message("x +"), message("x +"));
}

TEST(Expression, ImplicitMultiplication) {
  EXPECT_EQ(value("2x", {3, 0, 0}), 6);
  EXPECT_EQ(value("-4.5(rho - 4)", {3, 4, 7}), -4.5);
  EXPECT_EQ(value("(x)(y)", {3, 4, 0}), 12);
  EXPECT_EQ(value("x(y + 1)", {3, 4, 0}), 15);
  EXPECT_EQ(value("2x^2", {3, 0, 0}), 18);
  EXPECT_EQ(value("2 pi"), 2 * pi);
}

TEST(Expression, FunctionsAgreeWithMathematics) {
  EXPECT_DOUBLE_EQ(value("sin(pi/6)"), 0.5);
  EXPECT_DOUBLE_EQ(value("atan2(1, -1)"), 3 * pi / 4);
  EXPECT_DOUBLE_EQ(value("log(e)"), 1);
  EXPECT_DOUBLE_EQ(value("log10(1000)"), 3);
  EXPECT_DOUBLE_EQ(value("log2(8)"), 3);
  EXPECT_DOUBLE_EQ(value("pow(2, 0.5)"), std::numbers::sqrt2);
  EXPECT_EQ(value("hypot(3, 4)"), 5);
  EXPECT_EQ(value("clamp(0, 5, 3)"), 3);
  EXPECT_EQ(value("clamp(0, -5, 3)"), 0);
  EXPECT_EQ(value("min(3, 1, 2)"), 1);
  EXPECT_EQ(value("max(3, 1, 2)"), 3);
  EXPECT_EQ(value("avg(1, 2, 6)"), 3);
  EXPECT_EQ(value("sum(1, 2, 6)"), 9);
  EXPECT_EQ(value("sgn(-3) + sgn(0) + 10 sgn(2)"), 9);
  EXPECT_EQ(value("frac(-2.25)"), -0.25);
  EXPECT_EQ(value("round(2.5) + round(-2.5)"), 0);
  EXPECT_EQ(value("trunc(-2.7)"), -2);
  EXPECT_DOUBLE_EQ(value("deg2rad(180)"), pi);
  EXPECT_DOUBLE_EQ(value("rad2deg(pi)"), 180);
  EXPECT_DOUBLE_EQ(value("normal_dist(1)"), std::exp(-0.5) / std::sqrt(2 * pi));
  EXPECT_DOUBLE_EQ(value("normal_dist(3, 1, 2)"), std::exp(-0.5) / (2 * std::sqrt(2 * pi)));
  EXPECT_EQ(value("if(x > 1, 5, 6)", {2, 0, 0}), 5);
  EXPECT_DOUBLE_EQ(value("exp(1)"), e);
}

TEST(Expression, Logic) {
  EXPECT_EQ(value("1 <> 2"), 1);
  EXPECT_EQ(value("1 != 1"), 0);
  EXPECT_EQ(value("1 = 1"), 1);
  EXPECT_EQ(value("true xor true"), 0);
  EXPECT_EQ(value("2 nand 3"), 0);
  EXPECT_EQ(value("0 nor 0"), 1);
  EXPECT_EQ(value("mand(1, 2, 3) + 10 mand(1, 0, 3) + 100 mand(7)"), 101);
  EXPECT_EQ(value("mor(0, 0, 3) + 10 mor(0, 0) + 100 mor(7)"), 101);
  EXPECT_EQ(value("x >= 2", {2, 0, 0}), 1);
}

TEST(Expression, Coordinates) {
  EXPECT_EQ(value("rho", {3, 4, 12}), 5);
  EXPECT_EQ(value("r", {3, 4, 12}), 13);
  EXPECT_EQ(value("phic", {-1, 0, 0}), pi);
  EXPECT_EQ(value("theta", {0, 2, 0}), pi / 2);
  EXPECT_EQ(value("phis", {0, 0, 0}), 0);
  EXPECT_EQ(value("phis", {0, 0, -2}), pi);
  EXPECT_EQ(value("PHIS + Rho + X", {0, 0, -2}), pi);
}

TEST(Expression, PrintsInOneWay) {
  Diagnostics d;
  EXPECT_EQ(parse("2X*( y+ 1)", d)->text(), "2*x*(y + 1)");
  EXPECT_EQ(parse("-(x^2)", d)->text(), "-x^2");
  EXPECT_EQ(parse("(-x)^2", d)->text(), "(-x)^2");
  EXPECT_EQ(parse("a ? b : c", d)->text(), "a ? b : c");
  EXPECT_EQ(parse("(x^y)^z", d)->text(), "(x^y)^z");
  EXPECT_EQ(parse("x-(y-z)", d)->text(), "x - (y - z)");
  for (const char* text :
       {"x - (y - z) - 1", "(x + 1)*(y/2)/3", "-x^-y", "(a ? b : c) + 1", "not(x)*2", "((x and y) or z) and 1",
        "2^(x + 1)", "--x", "2^-x^-2", "not not x", "not -x*2", "x ? y : z ? 1 : 2", "(x < y) < z", "x < (y < z)",
        "if(x, 1e-30, y)", "-(-x)", "(x ? 1 : 2) ? 3 : 4"}) {
    const auto once = parse(text, d);
    ASSERT_TRUE(once) << to_text(d);
    EXPECT_EQ(parse(once->text(), d)->text(), once->text());
    // The text has the same meaning.
    EXPECT_EQ(parse(once->text(), d)->constant_value(), once->constant_value());
  }
}

TEST(Expression, MessagesPointIntoTheString) {
  EXPECT_EQ(message("x + sine(y)"),
            "part.vcad:1:8: error: there is no function \"sine\" in expressions; did you mean \"sin\"?\n"
            "  1 | f(\"x + sine(y)\")\n"
            "    |        ^~~~\n");
  EXPECT_EQ(message("x + rhoo"),
            "part.vcad:1:8: error: there is no variable \"rhoo\" in this expression; did you mean \"rho\"?\n"
            "  1 | f(\"x + rhoo\")\n"
            "    |        ^~~~\n");
  EXPECT_NE(message("x + ").find("the expression ends where a number, a name or \"(\" was expected"),
            std::string::npos);
  EXPECT_NE(message("").find("the expression is empty"), std::string::npos);
  EXPECT_NE(message("(x").find("where \")\" was expected"), std::string::npos);
  EXPECT_NE(message("x := 3").find("assignments"), std::string::npos);
  EXPECT_NE(message("atan2(1)").find("atan2 takes (y, x), 1 argument was given"), std::string::npos);
  EXPECT_NE(message("sin").find("needs its arguments"), std::string::npos);
  EXPECT_NE(message("1e999").find("too large"), std::string::npos);
  EXPECT_NE(message(std::string(1000, '(')).find("nests deeper"), std::string::npos);
}

TEST(Expression, LinearFunctionsAreKnown) {
  const auto linear = [](const std::string& text) {
    Diagnostics diagnostics;
    const auto parsed = Expression::parse(text, {}, diagnostics);
    return parsed ? parsed->linear_in("t") : std::nullopt;
  };
  using Linear = Expression::Linear;
  EXPECT_EQ(linear("3"), (Linear{3, 0}));
  EXPECT_EQ(linear("t"), (Linear{0, 1}));
  EXPECT_EQ(linear("1 - 0.5*t"), (Linear{1, -0.5}));
  EXPECT_EQ(linear("-(t - 4) / 2 + 2*(3*t + 1)"), (Linear{4, 5.5}));
  EXPECT_EQ(linear("t * sqrt(4) + max(1, 3)"), (Linear{3, 2}));
  EXPECT_EQ(linear("sqrt(t)"), std::nullopt);
  EXPECT_EQ(linear("t*t"), std::nullopt);
  EXPECT_EQ(linear("1/t"), std::nullopt);
  EXPECT_EQ(linear("t + x"), std::nullopt);
  EXPECT_EQ(linear("t < 0.5"), std::nullopt);
}

namespace {

// An input that is the point's x times a number.
class Multiple : public Input {
 public:
  explicit Multiple(double by) : by_(by) {}
  program::Field field(const program::Point& p) const override { return p.x * by_; }
  std::string name() const override { return "multiple"; }
  bool is_same(const Input& other) const override { return static_cast<const Multiple&>(other).by_ == by_; }

 private:
  double by_;
};

Expression multiple(double by) { return Expression::of_input(std::make_shared<Multiple>(by)); }

Expression parsed(const std::string& text) {
  Diagnostics diagnostics;
  return *Expression::parse(text, {}, diagnostics);
}

}  // namespace

TEST(Expression, AreComputedWith) {
  const Expression x = parsed("x"), sum = parsed("x + 1");
  EXPECT_EQ(Expression::binary(Binary::multiply, sum, sum).text(), "(x + 1)*(x + 1)");
  EXPECT_EQ(Expression::negate(Expression::binary(Binary::power, x, Expression::constant(-2))).text(), "-x^-2");
  EXPECT_EQ(Expression::call("max", {x, sum}).text(), "max(x, x + 1)");
  EXPECT_EQ(Expression::conditional(x, sum, x).text(), "x ? x + 1 : x");
  EXPECT_EQ(Expression::binary(Binary::add, x, Expression::constant(1)), sum);
}

TEST(Expression, WhatIsComputedReadsBack) {
  const Expression x = parsed("x"), y = parsed("-y"), half = Expression::constant(-0.5);
  std::vector<Expression> made{x, y, half};
  for (int round = 0; round < 2; ++round) {
    std::vector<Expression> more;
    for (const Expression& a : made) {
      more.push_back(Expression::negate(a));
      more.push_back(Expression::logical_not(a));
      for (const Expression& b : round == 0 ? made : std::vector{x, half}) {
        for (const Binary binary : {Binary::add, Binary::subtract, Binary::divide, Binary::mod, Binary::power,
                                    Binary::less, Binary::equal, Binary::logical_and, Binary::logical_or})
          more.push_back(Expression::binary(binary, a, b));
        more.push_back(Expression::conditional(a, b, a));
        more.push_back(Expression::conditional(b, a, y));
      }
    }
    for (const Expression& expression : more) EXPECT_EQ(parsed(expression.text()).text(), expression.text());
    made = std::move(more);
  }
}

TEST(Expression, InputsAreNumberedInTheirOrder) {
  const Expression two = multiple(2), three = multiple(3);
  EXPECT_EQ(two.text(), "v");
  EXPECT_EQ(Expression::binary(Binary::add, two, multiple(2)).text(), "v + v");
  const Expression difference = Expression::binary(Binary::subtract, three, two);
  EXPECT_EQ(difference.text(), "v1 - v2");
  EXPECT_EQ(difference.text_with_names(), "multiple - multiple");
  EXPECT_NE(difference, Expression::binary(Binary::subtract, two, three));
  EXPECT_EQ(difference, Expression::binary(Binary::subtract, multiple(3), multiple(2)));
  EXPECT_EQ(difference.constant_value(), std::nullopt);
  EXPECT_EQ(difference.linear_in("x"), std::nullopt);
}

TEST(Expression, VariablesMayStandForOthers) {
  const auto other = [](const Node& variable) -> std::optional<Expression> {
    if (variable.name == "a") return parsed("x + 1");
    if (variable.name == "b") return multiple(2);
    return std::nullopt;
  };
  EXPECT_EQ(parsed("2*a - max(a, y)").with_substitutes(other).text(), "2*(x + 1) - max(x + 1, y)");
  EXPECT_EQ(parsed("b ? b : z").with_substitutes(other).text(), "v ? v : z");
  EXPECT_EQ(parsed("y + z").with_substitutes(other), parsed("y + z"));
  std::string sum = "a";
  for (int i = 0; i < 100000; ++i) sum += "+x";
  EXPECT_EQ(parsed(sum).with_substitutes(other).text().substr(0, 13), "x + 1 + x + x");
}

TEST(Expression, LongSumsNeitherOverflowNorHang) {
  std::string sum = "x";
  for (int i = 0; i < 100000; ++i) sum += "+x";
  EXPECT_EQ(value(sum, {1, 0, 0}), 100001);
}

}  // namespace ombre::expr
