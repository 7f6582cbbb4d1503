// Compares ramps, tables, colours, textures, mixtures and attributes with mathematics and SciPy.
#include "nodes/test_values.h"
#include "program/evaluate.h"

namespace ombre::nodes {
namespace {

using namespace test;

class ValueCurves : public ValueTest {};

}  // namespace

TEST_F(ValueCurves, RampsAndRangesAreStraightOrSmooth) {
  const auto ramp = [&](const char* shape, double x) {
    return number_at(make("ramp", {{"of", Data("x")}, {"lo", Data(2.0)}, {"hi", Data(6.0)}, {"shape", Data(shape)}}),
                     "value", {x, 0, 0});
  };
  EXPECT_EQ(ramp("linear", 1), 0);
  EXPECT_EQ(ramp("linear", 3), 0.25);
  EXPECT_EQ(ramp("linear", 9), 1);
  EXPECT_EQ(ramp("smooth", 3), 0.15625);        // 3/16 - 2/64
  EXPECT_EQ(ramp("smoother", 3), 0.103515625);  // 6/1024 - 15/256 + 10/64
  EXPECT_EQ(ramp("step", 3.9), 0);
  EXPECT_EQ(ramp("step", 4), 1);
  const Named range{
      {"of", Data("x")}, {"from_lo", Data(0.0)}, {"from_hi", Data(10.0)}, {"to_lo", Data(5.0)}, {"to_hi", Data(1.0)}};
  EXPECT_NEAR(number_at(make("rescale", range), "value", {20, 0, 0}), -3, 1e-12);
  Named clamped = range;
  clamped.emplace_back("clamp", Data(true));
  EXPECT_NEAR(number_at(make("rescale", clamped), "value", {20, 0, 0}), 1, 1e-12);
}

// Expected values come from tests/fixtures/make_table_values.py, which uses SciPy 1.17.
TEST_F(ValueCurves, CubicTablesAreSciPysPchip) {
  const NodePtr table = make("table", {{"rows", rows({{0, 1}, {1, 3}, {2.5, 3}, {3, 2}, {5, 4}, {8, 4.5}})},
                                       {"a", Data("x")},
                                       {"mode", Data("cubic")}});
  const double at_x[] = {0.0, 0.3, 0.9, 1.7, 2.6, 3.5, 4.2, 6.1, 7.9};
  const double expected[] = {1.0, 1.8436, 2.9692, 3.0, 2.896, 2.284375, 3.2096, 4.284737037037037, 4.499337037037037};
  for (size_t n = 0; n < std::size(at_x); ++n)
    EXPECT_NEAR(number_at(table, "value", {at_x[n], 0, 0}), expected[n], 1e-12);
  const NodePtr two = make("table", {{"rows", rows({{0, 2}, {1, 5}})}, {"a", Data("x")}, {"mode", Data("cubic")}});
  EXPECT_NEAR(number_at(two, "value", {0.25, 0, 0}), 2.75, 1e-12);
}

TEST_F(ValueCurves, TablesOfThreeInputsAreSciPysGrid) {
  DataList data;
  const double keys[3][3] = {{0, 1, 4}, {-1, 2}, {0, 0.5, 2}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 3; ++k)
        data.push_back(list({keys[0][i], keys[1][j], keys[2][k], i * 1.5 - j * j + 2 * k + i * k}));
  std::shuffle(data.begin(), data.end(), random_);  // rows may be in any order
  const NodePtr table =
      make("table", {{"rows", Data(data)}, {"a", Data("x")}, {"more", Data(DataList{Data("y"), Data("z")})}});
  EXPECT_NEAR(number_at(table, "value", {0.5, 0.0, 0.25}), 1.666666666666667, 1e-12);
  EXPECT_NEAR(number_at(table, "value", {2.0, 1.5, 1.0}), 5.611111111111111, 1e-12);
  EXPECT_NEAR(number_at(table, "value", {3.9, -0.9, 1.9}), 10.585555555555555, 1e-12);
  EXPECT_NEAR(number_at(table, "value", {1.0, 2.0, 0.5}), 3.5, 1e-12);
}

TEST_F(ValueCurves, TablesEndAsRequested) {
  const Named table{{"rows", rows({{0, 1, 10}, {2, 5, 20}})}, {"a", Data("x")}};
  const auto value = [&](const char* mode, const char* outside, double x) {
    Named all = table;
    all.emplace_back("mode", Data(mode));
    all.emplace_back("outside", Data(outside));
    all.emplace_back("otherwise", Data(-7.0));
    return vector_at(make("table", all), "values", {x, 0, 0});
  };
  expect_near(value("linear", "clamp", 1), {3, 15, 0}, 1e-12);
  expect_near(value("linear", "clamp", 5), {5, 20, 0}, 0);
  expect_near(value("step", "clamp", 1.9), {1, 10, 0}, 0);
  expect_near(value("step", "clamp", 2), {5, 20, 0}, 0);
  EXPECT_EQ(value("linear", "value", -0.1).x, -7);
  EXPECT_TRUE(std::isnan(value("linear", "error", 2.1).x));
}

TEST_F(ValueCurves, WrongTablesSayWhatIsWrong) {
  const auto error = [&](Data data, const char* mode = "linear") {
    return error_of("table", {{"rows", std::move(data)}, {"a", Data("x")}, {"mode", Data(mode)}});
  };
  EXPECT_NE(error(Data(DataList{})).find("no rows"), std::string::npos);
  EXPECT_NE(error(rows({{0, 1}, {0, 2}})).find("not sorted: row 2 has the key 0 after 0"), std::string::npos);
  EXPECT_NE(error(rows({{0, 1}, {1}})).find("row 2 of the table has 1 numbers"), std::string::npos);
  const std::string gaps = error_of(
      "table",
      {{"rows", rows({{0, 0, 1}, {0, 1, 1}, {1, 0, 1}})}, {"a", Data("x")}, {"more", Data(DataList{Data("y")})}});
  EXPECT_NE(gaps.find("the table has gaps"), std::string::npos);
  const std::string cubic = error_of(
      "table",
      {{"rows", rows({{0, 0, 1}})}, {"a", Data("x")}, {"more", Data(DataList{Data("y")})}, {"mode", Data("cubic")}});
  EXPECT_NE(cubic.find("cubic tables have one input"), std::string::npos);
}

// Expected values are Lindbloom's for sRGB red under D65; HSV follows its definition.
TEST_F(ValueCurves, ColoursChangeTheirSpace) {
  const auto colour = [&](Vec3 numbers, const char* space, const char* to) {
    return vector_at(
        make("colour",
             {{"numbers", list({numbers.x, numbers.y, numbers.z})}, {"space", Data(space)}, {"to", Data(to)}}),
        "colour", {});
  };
  expect_near(colour({1, 0, 0}, "srgb", "lab"), {53.2408, 80.0925, 67.2032}, 2e-3);
  expect_near(colour({0.5, 0.5, 0.5}, "srgb", "linear"), {0.214041, 0.214041, 0.214041}, 1e-6);
  expect_near(colour({210, 1, 1}, "hsv", "srgb"), {0, 0.5, 1}, 1e-12);
  expect_near(colour({0.2, 0.4, 0.3}, "srgb", "hsv"), {150, 0.5, 0.4}, 1e-9);
  for (int n = 0; n < 20; ++n) {
    const Vec3 p = 0.5 * (random_point(1) + Vec3{1, 1, 1});
    for (const char* space : {"linear", "hsv", "lab"})
      expect_near(colour(colour(p, "srgb", space), space, "srgb"), p, 1e-5);
  }
  const NodePtr difference = make("colour_difference", {{"a", list({1, 0, 0})}, {"b", list({0, 0, 0})}});
  EXPECT_NEAR(number_at(difference, "value", {}), std::sqrt(53.2408 * 53.2408 + 80.0925 * 80.0925 + 67.2032 * 67.2032),
              5e-3);
}

// The test image has two rows of two pixels, with red 0, 80, 160, 255 from the top.
TEST_F(ValueCurves, TexturesAreLinearBetweenTheMiddlesOfPixels) {
  const NodePtr planar = make("texture", {{"path", Data("image.png")}, {"width", Data(4.0)}, {"wrap", Data("clamp")}});
  EXPECT_NEAR(vector_at(planar, "colour", {-1, 1, 9}).x, 0, 1e-12);
  EXPECT_NEAR(vector_at(planar, "colour", {1, 1, 9}).x, 80 / 255.0, 1e-12);
  EXPECT_NEAR(vector_at(planar, "colour", {0, 1, 9}).x, 40 / 255.0, 1e-12);
  EXPECT_NEAR(vector_at(planar, "colour", {9, -9, 9}).x, 1, 1e-12);
  const NodePtr tiled = make("texture", {{"path", Data("image.png")}, {"width", Data(4.0)}});
  expect_near(vector_at(tiled, "colour", {3, 1.3, 0}), vector_at(tiled, "colour", {-1, -2.7, 0}), 1e-12);
  EXPECT_NE(
      error_of("texture", {{"path", Data("image.png")}, {"projection", Data("triplanar")}}).find("lies on a solid"),
      std::string::npos);
}

TEST_F(ValueCurves, MixturesOfManyHaveTheirShares) {
  const NodePtr mix = make("mix_many", {{"materials", Data(DataList{Data("red"), Data("blue"), Data("clear")})},
                                        {"shares", Data(DataList{Data(1.0), Data("x"), Data("-1")})}});
  const auto fractions = of_output(mix, "mixture", {3, 0, 0});
  EXPECT_NEAR(fractions[0], 0.25, 1e-12);
  EXPECT_NEAR(fractions[1], 0.75, 1e-12);
  EXPECT_EQ(fractions[2], 0);
  const NodePtr lost = make("mix_many", {{"materials", Data(DataList{Data("red"), Data("blue")})},
                                         {"shares", Data(DataList{Data("sqrt(x)"), Data("y")})}});
  EXPECT_NEAR(of_output(lost, "mixture", {-1, 3, 0})[1], 1, 1e-12);
  EXPECT_NEAR(of_output(lost, "mixture", {4, 6, 0})[1], 0.75, 1e-12);
  EXPECT_NEAR(of_output(lost, "mixture", {-1, 0, 0})[0], 1, 1e-12);  // no share is above 0
  EXPECT_NE(error_of("mix_many",
                     {{"materials", Data(DataList{Data("red")})}, {"shares", Data(DataList{Data(1.0), Data(2.0)})}})
                .find("2 shares for 1 materials"),
            std::string::npos);
}

TEST_F(ValueCurves, AttributesHaveTheTypesOfTheirValuesAndNames) {
  const NodePtr ball = make("sphere", {});
  const auto type_of = [&](const char* name, Data value) {
    return make("attribute", {{"name", Data(name)}, {"value", std::move(value)}}, {ball})->declares()->type;
  };
  EXPECT_EQ(type_of("stress", Data("x")), ValueType::number);
  EXPECT_EQ(type_of("fibre", list({1, 0, 0})), ValueType::vector);
  EXPECT_EQ(type_of("tint", Data("#ff8000")), ValueType::colour);
  EXPECT_EQ(type_of("color_rgba", list({1, 0.5, 0})), ValueType::colour);
  EXPECT_EQ(type_of("color_rgba", Data("red")), ValueType::colour);
  EXPECT_EQ(type_of("tissue", Data("red")), ValueType::mixture);
  const auto declared = make("attribute", {{"name", Data("modulus")}, {"value", Data(5.0)}}, {ball})->declares();
  EXPECT_EQ(declared->unit, "MPa");
  EXPECT_EQ(declared->range, Interval(0, std::numeric_limits<double>::infinity()));
}

TEST_F(ValueCurves, WrongAttributesSayWhatIsWrong) {
  const NodePtr ball = make("sphere", {});
  const auto error = [&](const char* name, Data value) {
    Named more;
    more.emplace_back("name", Data(name));
    more.emplace_back("value", std::move(value));
    return error_of("attribute", more, {ball});
  };
  EXPECT_NE(error("modulus", list({1, 2, 3})).find("is a number, and its value is a vector"), std::string::npos);
  EXPECT_NE(error("a.b", Data(3.0)).find("has a dot"), std::string::npos);
  EXPECT_NE(error("tint", Data("#ff80")).find("expected a colour such as"), std::string::npos);
}

TEST_F(ValueCurves, StandardNamesWarnOfOtherUnitsAndRanges) {
  const NodePtr ball = make("sphere", {});
  make("attribute", {{"name", Data("infill_density")}, {"value", Data(120.0)}}, {ball});
  EXPECT_NE(to_text(diagnostics_).find("is from 0 to 100 %, found 120"), std::string::npos);
  make("attribute", {{"name", Data("modulus")}, {"value", Data(3.0)}, {"unit", Data("GPa")}}, {ball});
  EXPECT_NE(to_text(diagnostics_).find("has the unit MPa as a standard name, and GPa here"), std::string::npos);
  EXPECT_FALSE(diagnostics_.has_errors());
}

TEST_F(ValueCurves, FormulasCallAttributesOfTheChild) {
  const NodePtr ball = make("sphere", {});
  const NodePtr stiff = make("attribute", {{"name", Data("Modulus")}, {"value", Data("100 + x")}}, {ball});
  const NodePtr fibre =
      make("attribute", {{"name", Data("fibre")}, {"value", Data(DataList{Data("y"), Data(0.0), Data(1.0)})}}, {stiff});
  const NodePtr both = make("attribute", {{"name", Data("sum")}, {"value", Data("modulus/2 + fibre.x")}}, {fibre});
  LoweringContext context(materials_, {both});
  program::Builder builder;
  Lowering lowering(context, builder);
  const Field sum = lowering.attribute(*both, "sum", Point::origin_frame(builder), Demand::inside);
  std::vector<double> values;
  const program::Program program = builder.finish({{"sum", sum}});
  evaluate_point(program, {4, 3, 0}, values);
  EXPECT_EQ(values[program.outputs[0]], 55);
  const NamedValues script = [](const std::string& name) {
    return name == "modulus" ? std::optional(Data(3.0)) : std::nullopt;
  };
  const NodeType& type = *registry().find("attribute");
  diagnostics_ = {};
  EXPECT_FALSE(make_node(type, {{&type.parameters[0], Data("sum")}, {&type.parameters[1], Data("modulus")}}, {stiff},
                         {materials_, diagnostics_, nullptr, {}, "", "", &script}));
  EXPECT_NE(to_text(diagnostics_).find("is an attribute of what is inside the braces"), std::string::npos);
}

}  // namespace ombre::nodes
