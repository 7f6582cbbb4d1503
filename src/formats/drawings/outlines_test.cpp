// Compares files of outlines with the formats' specifications.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/containers/append_numbers.h"
#include "formats/drawings/cli.h"
#include "formats/drawings/svg.h"

namespace ombre::formats {
namespace {

OutlineDocument two_regions() {
  return {"part", {{-1, -2, 0}, {3, 4, 5}}, {{"red, 50 %", {255, 0, 16, 255}}, {"a < b", {0, 0, 0, 51}}}};
}

// Returns a square with a hole, and no polygon of the second region.
OutlinePolygons square_with_hole() {
  return {{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{0.5, 0.5}, {0.5, 1}, {1, 0.5}}}, {}};
}

std::string decimal(double value) {
  std::string text;
  append_decimal(text, value);
  return text;
}

}  // namespace

TEST(Decimals, AreShortAndNeverExponents) {
  EXPECT_EQ(decimal(0), "0");
  EXPECT_EQ(decimal(-1e-9), "0");
  EXPECT_EQ(decimal(100), "100");
  EXPECT_EQ(decimal(-0.25), "-0.25");
  EXPECT_EQ(decimal(1e-6), "0.000001");
  EXPECT_EQ(decimal(1e21), "1000000000000000000000");
}

TEST(Svg, IsInMillimetresWithYDown) {
  EXPECT_EQ(svg_bytes(two_regions(), "part, z 1 mm", square_with_hole()),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"4mm\" height=\"6mm\""
            " viewBox=\"-1 -4 4 6\">\n"
            "<title>part, z 1 mm</title>\n"
            "<path id=\"region-1\" fill=\"#FF0010\" fill-rule=\"evenodd\""
            " d=\"M0 0L2 0L2 -2L0 -2ZM0.5 -0.5L0.5 -1L1 -0.5Z\"><title>red, 50 %</title></path>\n"
            "</svg>\n");
}

TEST(Svg, KeepsTransparencyAndEscapesNames) {
  const std::string text = svg_bytes(two_regions(), "", {{}, {{{0, 0}, {1, 0}, {0, 1}}}});
  EXPECT_NE(text.find("id=\"region-2\" fill=\"#000000\" fill-opacity=\"0.2\""), std::string::npos);
  EXPECT_NE(text.find("<title>a &lt; b</title>"), std::string::npos);
}

TEST(Cli, NamesLayersByTheirUpperFaces) {
  EXPECT_EQ(cli_header(two_regions(), 1, -0.5) + cli_layer(0.5, square_with_hole()) + cli_end(),
            "$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$VERSION/200\n"
            "$$LABEL/1,red_ 50 %\n$$LABEL/2,a < b\n"
            "$$DIMENSION/-1,-2,0,3,4,5\n$$LAYERS/2\n$$HEADEREND\n"
            "$$GEOMETRYSTART\n$$LAYER/-0.5\n$$LAYER/0.5\n"
            "$$POLYLINE/1,1,5,0,0,2,0,2,2,0,2,0,0\n"
            "$$POLYLINE/1,0,4,0.5,0.5,0.5,1,1,0.5,0.5,0.5\n"
            "$$GEOMETRYEND\n");
}

namespace {

const std::vector<std::vector<Vec2>> square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};

void expect_line(const Hatch& hatch, Vec2 from, Vec2 to) {
  EXPECT_NEAR(hatch.from.x, from.x, 1e-12);
  EXPECT_NEAR(hatch.from.y, from.y, 1e-12);
  EXPECT_NEAR(hatch.to.x, to.x, 1e-12);
  EXPECT_NEAR(hatch.to.y, to.y, 1e-12);
}

double length_of(const std::vector<Hatch>& hatches) {
  double sum = 0;
  for (const Hatch& hatch : hatches) sum += std::hypot(hatch.to.x - hatch.from.x, hatch.to.y - hatch.from.y);
  return sum;
}

}  // namespace

TEST(Hatches, GoToAndFro) {
  const auto along_x = hatches_of(square, {1, 0, 90}, 0);
  ASSERT_EQ(along_x.size(), 2U);
  expect_line(along_x[0], {0, 0.5}, {2, 0.5});
  expect_line(along_x[1], {2, 1.5}, {0, 1.5});
  const auto along_y = hatches_of(square, {1, 0, 90}, 1);
  ASSERT_EQ(along_y.size(), 2U);
  expect_line(along_y[0], {1.5, 0}, {1.5, 2});
  expect_line(along_y[1], {0.5, 2}, {0.5, 0});
}

// Lines at a distance that goes to zero cover the area.
TEST(Hatches, CoverTheArea) {
  std::vector<std::vector<Vec2>> with_hole = square;
  with_hole.push_back({{0.5, 0.5}, {0.5, 1}, {1, 0.5}});
  for (const double angle : {0.0, 30.0, 67.0, 90.0, 213.0})
    EXPECT_NEAR(0.001 * length_of(hatches_of(with_hole, {0.001, angle, 0}, 0)), 4 - 0.125, 5e-3) << angle;
  EXPECT_TRUE(hatches_of({}, {}, 0).empty());
  EXPECT_TRUE(hatches_of({{{0, 0}, {1, 0}, {2, 0}}}, {0.1, 0, 0}, 0).empty());
}

TEST(Cli, HasHatchesBehindOutlines) {
  CliRules rules;
  rules.hatch = HatchRule{1, 0, 0};
  EXPECT_EQ(cli_layer(0.5, {square, {}}, rules),
            "$$LAYER/0.5\n$$POLYLINE/1,1,5,0,0,2,0,2,2,0,2,0,0\n$$HATCHES/1,2,0,0.5,2,0.5,2,1.5,0,1.5\n");
}

// The commands of the long form: 127 and a height; 130, id, direction, number of points, points; 132, id, number of
// hatches, their ends. Numbers have 32 bits, commands 16, the lowest byte first.
TEST(Cli, BinaryCommandsAreThoseOfTheLongForm) {
  CliRules rules{true, HatchRule{2, 0, 0}};
  std::string expected;
  const auto command = [&](unsigned index) { expected += static_cast<char>(index), expected += '\0'; };
  const auto reals = [&](std::initializer_list<double> values) {
    for (const double value : values) append_f32(expected, value);
  };
  const auto integers = [&](std::initializer_list<uint32_t> values) {
    for (const uint32_t value : values) append_u32(expected, value);
  };
  command(127), reals({0.5});
  command(130), integers({1, 1, 5}), reals({0, 0, 2, 0, 2, 2, 0, 2, 0, 0});
  command(132), integers({1, 1}), reals({0, 1, 2, 1});
  EXPECT_EQ(cli_layer(0.5, {square}, rules), expected);
  const std::string header = cli_header(two_regions(), 1, -0.5, rules);
  EXPECT_NE(header.find("$$BINARY\n"), std::string::npos);
  EXPECT_EQ(header.substr(header.find("$$HEADEREND") + 11).size(), 6U);  // the layer that says where the part begins
  EXPECT_EQ(cli_end(rules), "");
}

}  // namespace ombre::formats
