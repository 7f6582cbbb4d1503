#include "calibration/calibration.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "base/system/test_source_files.h"
#include "calibration/piecewise.h"
#include "calibration/test_calibrations.h"

namespace ombre::calibration {
namespace {

using namespace test;

namespace fs = std::filesystem;

std::vector<CalibrationPtr> shipped() {
  std::vector<CalibrationPtr> all;
  for (const auto& entry : fs::directory_iterator(source_file("data/calibrations"))) {
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    Diagnostics diagnostics;
    all.push_back(parse_calibration(make_source(entry.path().string(), text.str()), diagnostics));
    EXPECT_TRUE(all.back()) << to_text(diagnostics);
    if (!all.back()) continue;
    EXPECT_EQ(all.back()->name, entry.path().stem().string());
  }
  EXPECT_GE(all.size(), 3U);
  return all;
}

std::string messages(const std::string& members) {
  Diagnostics diagnostics;
  const auto calibration = parse_calibration(make_source("c.json", text_of(members)), diagnostics);
  EXPECT_EQ(calibration != nullptr, !diagnostics.has_errors());
  return to_text(diagnostics);
}

void expect_message(const std::string& members, const std::string& part) {
  const std::string text = messages(members);
  EXPECT_NE(text.find(part), std::string::npos) << members << "\ngave: " << text;
}

double at(const Piecewise& curve, double key) {
  if (curve.of_logarithm) key = std::log(key);
  const auto above = std::ranges::lower_bound(curve.points, key, {}, [](const auto& point) { return point.first; });
  if (above == curve.points.begin()) return above->second;
  if (above == curve.points.end()) return curve.points.back().second;
  const auto& from = *(above - 1);
  return from.second + (key - from.first) / (above->first - from.first) * (above->second - from.second);
}

// Random inputs within what is valid, fractions of which sum to 1 at most.
std::vector<double> random_inputs(const Calibration& calibration, std::mt19937& random) {
  std::vector<double> inputs = calibration.usual();
  for (size_t n = 0; n < inputs.size(); ++n) {
    const Interval choices = calibration.choices(n, inputs);
    inputs[n] = std::uniform_real_distribution<>(choices.lo, choices.hi)(random);
  }
  return inputs;
}

void expect_inverse(const Calibration& calibration) {
  std::mt19937 random(1);
  for (int draw = 0; draw < 200; ++draw) {
    const std::vector<double> inputs = random_inputs(calibration, random);
    const double value = calibration.value(inputs);
    for (size_t n = 0; n < inputs.size(); ++n) {
      const Inverse inverse = calibration.inverse(n, value, inputs);
      EXPECT_TRUE(inverse.is_within);
      EXPECT_NEAR(inverse.input, inputs[n], 1e-6) << calibration.name;
      const Interval reach = calibration.reach(n, inputs);
      EXPECT_TRUE(reach.lo <= value && value <= reach.hi);
      if (draw >= 5) continue;
      const Interval choices = calibration.choices(n, inputs);
      EXPECT_NEAR(at(inverse_curve(calibration, n, inputs), value), inputs[n], 1e-6 * (choices.hi - choices.lo))
          << calibration.name;
      EXPECT_NEAR(at(forward_curve(calibration, n, inputs), inputs[n]), value, 1e-6 * reach.hi);
    }
  }
}

// Calibrations of inks have a profile in place of points.
CalibrationPtr of_inks(const std::string& members, Diagnostics& diagnostics) {
  const std::string text = R"({"name": "inks", "title": "t", "citation": "c", "licence": "l", "profile": "p.icc", )"
                           R"("rest": "White", )" +
                           members + "}";
  return parse_calibration(make_source("c.json", text), diagnostics);
}

}  // namespace

TEST(Calibration, InverseAfterForwardIsTheIdentityForAllThatAreShipped) {
  for (const CalibrationPtr& calibration : shipped()) expect_inverse(*calibration);
}

TEST(Calibration, InverseAfterForwardIsTheIdentityForAllInterpolants) {
  const std::string of_fraction = R"("inputs": [{"fraction": "Vero"}], "rest": "Agilus", "interpolant": )";
  expect_inverse(
      *made(of_fraction + R"("pchip", "points": [{"inputs": [0], "value": 0.4}, {"inputs": [0.2], "value": 3},
      {"inputs": [0.45], "value": 55}, {"inputs": [0.6], "value": 400}, {"inputs": [1], "value": 2850}])"));
  expect_inverse(*made(R"("inputs": [{"attribute": "temperature"}], "interpolant": "pchip",
      "points": [{"inputs": [200], "value": 1.25}, {"inputs": [215], "value": 1.1}, {"inputs": [230], "value": 0.7},
                 {"inputs": [260], "value": 0.5}])"));
  expect_inverse(*law("mixture", R"("values": [3, 8])"));
  expect_inverse(*law("log-mixture", R"("values": [0.383, 2850])"));
  expect_inverse(*law("kerner", R"("values": [0.383, 2850], "poissons_ratio": 0.49)"));
  expect_inverse(*law("percolation", R"("values": [0.383, 2850], "threshold": 0.3116, "exponent": 2)"));
  for (const char* name : {"linear", "log-linear"})
    expect_inverse(*made(R"("inputs": [{"attribute": "temperature"}, {"attribute": "dose"}], "interpolant": ")" +
                         std::string(name) + R"(", "points": [
      {"inputs": [200, 1], "value": 1}, {"inputs": [200, 2], "value": 2}, {"inputs": [200, 5], "value": 3},
      {"inputs": [250, 1], "value": 2.5}, {"inputs": [250, 2], "value": 4}, {"inputs": [250, 5], "value": 9}])"));
  expect_inverse(*made(R"("inputs": [{"fraction": "A"}, {"fraction": "B"}], "rest": "C", "interpolant": "mixture",
      "constants": {"values": [1, 5, 9]})"));
}

// Jacobs 1992: the depth grows by the penetration depth whenever the dose grows by a factor of e.
TEST(Calibration, WorkingCurvesAreThoseOfJacobs) {
  const std::string members = R"("property": "cure_depth", "unit": "mm", "interpolant": "working-curve", )";
  const std::string constants = R"("constants": {"penetration": 0.1, "critical": 8})";
  const auto curve =
      made(members + R"("inputs": [{"attribute": "dose", "unit": "mJ/cm2", "valid": [8, 400]}], )" + constants);
  EXPECT_EQ(curve->value(std::vector{8.0}), 0);
  EXPECT_NEAR(curve->value(std::vector{8 * std::exp(1.5)}), 0.15, 1e-12);
  EXPECT_NEAR(curve->inverse(0, 0.05, curve->usual()).input, 8 * std::exp(0.5), 1e-9);
  EXPECT_FALSE(curve->inverse(0, 0.5, curve->usual()).is_within);
  expect_inverse(*curve);
  expect_message(members + R"("inputs": [{"fraction": "A"}], "rest": "B", )" + constants,
                 "input of a working curve is a dose");
  expect_message(members + R"("inputs": [{"attribute": "dose"}], )" + constants, "for which it is \"valid\"");
  expect_message(members + R"("inputs": [{"attribute": "dose", "valid": [1, 9]}], )" + constants,
                 "below the critical dose, 8, nothing is cured");
  expect_message(members + R"("inputs": [{"attribute": "dose", "valid": [8, 9]}], "constants": {"critical": 8})",
                 "needs the \"penetration\" depth and the \"critical\" dose");
}

// Expected values come from scipy.interpolate.PchipInterpolator of SciPy 1.17.1.
TEST(Calibration, PchipIsThatOfSciPy) {
  const auto rising = made(R"("inputs": [{"fraction": "Vero"}], "rest": "Agilus", "interpolant": "pchip",
      "points": [{"inputs": [0], "value": 0.4}, {"inputs": [0.2], "value": 3}, {"inputs": [0.45], "value": 55},
                 {"inputs": [0.6], "value": 400}, {"inputs": [1], "value": 2850}])");
  const std::pair<double, double> expected[] = {{0.1, 1.1075949367088609},  {0.2, 3.0},
                                                {0.3, 12.317097571956264},  {0.5, 118.78913198052867},
                                                {0.55, 245.57831157330338}, {0.75, 1045.4033802300837},
                                                {0.9, 2024.8472634918091},  {0.99, 2761.575059879939}};
  for (const auto& [share, value] : expected) {
    EXPECT_NEAR(rising->value(std::vector{share}), value, 1e-12 * value);
    EXPECT_NEAR(rising->inverse(0, value, rising->usual()).input, share, 1e-12);
  }
  const auto falling = made(R"("inputs": [{"attribute": "temperature"}], "interpolant": "pchip",
      "points": [{"inputs": [230], "value": 0.7}, {"inputs": [200], "value": 1.25}, {"inputs": [215], "value": 1.1},
                 {"inputs": [260], "value": 0.5}])");
  const std::pair<double, double> flows[] = {{205, 1.2235690235690235},
                                             {222, 0.9109198653198654},
                                             {229, 0.7141468013468012},
                                             {240, 0.5973544973544972},
                                             {255, 0.5068783068783069}};
  for (const auto& [celsius, flow] : flows) EXPECT_NEAR(falling->value(std::vector{celsius}), flow, 1e-14);
}

TEST(Calibration, LawsAreThoseOfTheLiterature) {
  const auto at = [](const CalibrationPtr& c, double share) { return c->value(std::vector{share}); };
  EXPECT_DOUBLE_EQ(at(law("mixture", R"("values": [3, 8])"), 0.25), 4.25);
  EXPECT_NEAR(at(law("log-mixture", R"("values": [1, 10000])"), 0.25), 10, 1e-12);
  // Kerner for rigid inclusions in a matrix that keeps its volume: 1 + 2.5 share / (1 - share), since A is 1.5.
  const auto rigid = law("kerner", R"("values": [1, 1e12], "poissons_ratio": 0.5)");
  EXPECT_NEAR(at(rigid, 0.2), 1 + 2.5 * 0.2 / 0.8, 1e-9);
  EXPECT_NEAR(at(law("kerner", R"("values": [2, 7], "poissons_ratio": 0.3)"), 1), 7, 1e-12);
  const auto percolates = law("percolation", R"("values": [1, 101], "threshold": 0.2, "exponent": 2)");
  EXPECT_EQ(at(percolates, 0.1), 1);
  EXPECT_NEAR(at(percolates, 0.6), 26, 1e-12);  // 1 + 100 ((0.6 - 0.2) / 0.8)^2
}

TEST(Calibration, OutOfReachGivesTheNearestValue) {
  const auto c = law("log-mixture", R"("values": [0.5, 2000])");
  const Inverse low = c->inverse(0, 0.1, c->usual()), high = c->inverse(0, 5000, c->usual());
  EXPECT_FALSE(low.is_within);
  EXPECT_EQ(low.input, 0);
  EXPECT_NEAR(low.nearest, 0.5, 1e-12);
  EXPECT_FALSE(high.is_within);
  EXPECT_EQ(high.input, 1);
  EXPECT_NEAR(high.nearest, 2000, 1e-9);
  EXPECT_FALSE(c->inverse(0, std::nan(""), c->usual()).is_within);
}

// Fractions of two materials leave no more than the rest.
TEST(Calibration, FractionsSumToOne) {
  const auto c = made(R"("inputs": [{"fraction": "A"}, {"fraction": "B", "usual": 0.4}], "rest": "C",
      "interpolant": "mixture", "constants": {"values": [1, 5, 9]})");
  EXPECT_EQ(c->choices(0, c->usual()), Interval(0, 0.6));
  EXPECT_NEAR(c->reach(0, c->usual()).lo, 1 + 0.4 * 8, 1e-12);
  EXPECT_NEAR(c->reach(0, c->usual()).hi, 5 * 0.6 + 9 * 0.4, 1e-12);
}

TEST(Calibration, SpreadsAreThoseOfPointsOrOfTheLaw) {
  const auto c = made(R"("inputs": [{"attribute": "dose"}], "interpolant": "linear",
      "points": [{"inputs": [0], "value": 1, "sd": 0.1, "n": 5}, {"inputs": [10], "value": 2, "sd": 0.3, "n": 5}])");
  EXPECT_NEAR(*c->spread(std::vector{5.0}), 0.2, 1e-12);
  EXPECT_EQ(law("mixture", R"("values": [3, 8])")->spread(std::vector{0.5}), std::nullopt);
  const auto relative = made(R"("inputs": [{"fraction": "A"}], "rest": "B", "interpolant": "mixture",
      "constants": {"values": [10, 20]}, "relative_sd": 0.1)");
  EXPECT_NEAR(*relative->spread(std::vector{0.5}), 1.5, 1e-12);
}

TEST(Calibration, ValuesThatRiseAndFallHaveNoInverse) {
  const auto c = made(R"("inputs": [{"attribute": "dose"}], "interpolant": "linear",
      "points": [{"inputs": [0], "value": 1}, {"inputs": [1], "value": 3}, {"inputs": [2], "value": 2}])");
  EXPECT_FALSE(c->is_invertible(0));
}

TEST(Calibration, MistakesAreExplained) {
  const std::string input = R"("inputs": [{"attribute": "dose"}], )";
  expect_message(input + R"("interpolant": "pchop", "points": [])", R"(did you mean "pchip"?)");
  expect_message(input + R"("interpolant": "pchip", "pointz": [])", R"(did you mean "points"?)");
  expect_message(input + R"("interpolant": "pchip")", "needs points");
  expect_message(input + R"("interpolant": "mixture", "points": [])", R"(needs "constants")");
  expect_message(input + R"("interpolant": "mixture", "constants": {"values": [1, 2]})", "are fractions");
  expect_message(R"("inputs": [{"fraction": "A"}], "interpolant": "mixture", "constants": {"values": [1, 2]})",
                 R"(fractions need "rest")");
  expect_message(
      R"("inputs": [{"fraction": "A"}], "rest": "B", "interpolant": "mixture", "constants": {"values": [1]})",
      "has 1 numbers for 2 materials");
  expect_message(R"("inputs": [], "interpolant": "linear", "points": [])", "one to three inputs, not 0");
  expect_message(
      input + R"("interpolant": "linear", "points": [{"inputs": [1], "value": 1}, {"inputs": [1], "value": 2}])",
      "same number for dose");
  expect_message(input + R"("interpolant": "linear", "points": [{"inputs": [1, 2], "value": 1}])", "has 2 inputs");
  expect_message(input + R"("interpolant": "log-linear", "points": [{"inputs": [1], "value": 0}])", "values above 0");
  expect_message(R"("inputs": [{"attribute": "dose", "valid": [0, 3]}], "interpolant": "linear",
                   "points": [{"inputs": [0], "value": 1}, {"inputs": [2], "value": 2}])",
                 "go from 0 to 2");
  expect_message(R"("inputs": [{"attribute": "dose"}, {"attribute": "temperature"}], "interpolant": "linear",
                   "points": [{"inputs": [0, 0], "value": 1}, {"inputs": [1, 0], "value": 2}, {"inputs": [0, 1], "value": 2}])",
                 "the points have gaps");
  expect_message(R"("inputs": [{"attribute": "dose", "fraction": "A"}], "interpolant": "linear", "points": [])",
                 "fraction");
  expect_message(R"("name": "Not Plain", "inputs": [], "interpolant": "linear")", "lower-case letters");
}

TEST(CalibrationOfInks, HasItsChannelsInTheOrderOfTheProfile) {
  Diagnostics diagnostics;
  const auto made = of_inks(R"("channels": {"K": "Black", "Y": ["Yellow", "Gold"], "M": "Magenta", "C": "Cyan"},
                               "intent": "absolute", "black_point": false, "clear": "Glass")",
                            diagnostics);
  ASSERT_TRUE(made) << to_text(diagnostics);
  ASSERT_TRUE(made->inks);
  EXPECT_EQ(made->inks->channels, (std::vector<std::string>{"C", "M", "Y", "K"}));
  EXPECT_EQ(made->inputs[0].materials.front(), "Cyan");
  EXPECT_EQ(made->inputs[2].materials, (std::vector<std::string>{"Yellow", "Gold"}));
  EXPECT_EQ(made->inks->intent, ink::Intent::absolute);
  EXPECT_FALSE(made->inks->black_point);
  EXPECT_EQ(made->inks->clear, std::vector<std::string>{"Glass"});
  EXPECT_TRUE(made->concerns("color_rgb") && made->concerns("color_rgba") && !made->concerns("modulus"));
  // Other names keep their order.
  const auto named = of_inks(R"("channels": {"Violet": "V", "Cyan": "C"})", diagnostics);
  ASSERT_TRUE(named) << to_text(diagnostics);
  EXPECT_EQ(named->inks->channels, (std::vector<std::string>{"Violet", "Cyan"}));
  EXPECT_EQ(named->inks->intent, ink::Intent::relative);
}

TEST(CalibrationOfInks, SaysWhatIsWrong) {
  const auto expect_part = [](const std::string& members, const std::string& part) {
    Diagnostics diagnostics;
    EXPECT_FALSE(of_inks(members, diagnostics)) << members;
    EXPECT_NE(to_text(diagnostics).find(part), std::string::npos) << members << "\ngave: " << to_text(diagnostics);
  };
  expect_part(R"("channels": {})", "\"channels\" is empty");
  expect_part(R"("intent": "relative")", "needs \"channels\"");
  expect_part(R"("channels": {"C": "Cyan"}, "intent": "media")", "media");
  expect_part(R"("channels": {"C": 3})", "\"C\"");
  expect_part(R"("channels": {"C": "Cyan"}, "points": [])", "points");
}

}  // namespace ombre::calibration
