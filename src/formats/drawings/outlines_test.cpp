// Compares files of outlines with the formats' specifications.
#include <gtest/gtest.h>

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

}  // namespace ombre::formats
