// Tests of drawings: areas and boxes from mathematics, and from OpenSCAD 2021.01 where SVG leaves a choice.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/math/box.h"
#include "formats/drawings/plane_files.h"
#include "formats/drawings/plane_writers.h"

namespace ombre::formats {
namespace {

struct Measured {
  double area = 0;  // signed area of the rings
  Box box;
  size_t shapes = 0, rings = 0;
};

Measured measured(const PlaneShapes& shapes) {
  Measured result;
  for (const auto& shape : shapes.shapes) {
    ++result.shapes;
    for (const Ring& ring : shape.rings) {
      ++result.rings;
      result.area += doubled_area(ring) / 2;
      for (const Vec2& p : ring) result.box = hull(result.box, Box{{p.x, p.y, 0}, {p.x, p.y, 0}});
    }
  }
  return result;
}

std::string svg_of(const std::string& attributes, const std::string& content) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + ">" + content + "</svg>";
}

Measured svg(const std::string& attributes, const std::string& content, const PlaneOptions& options = {}) {
  Diagnostics diagnostics;
  const auto shapes = read_svg("test.svg", svg_of(attributes, content), options, diagnostics);
  EXPECT_TRUE(shapes) << to_text(diagnostics);
  return shapes ? measured(*shapes) : Measured{};
}

void expect_box(const Box& box, double x0, double x1, double y0, double y1) {
  EXPECT_NEAR(box.lo.x, x0, 1e-4);
  EXPECT_NEAR(box.hi.x, x1, 1e-4);
  EXPECT_NEAR(box.lo.y, y0, 1e-4);
  EXPECT_NEAR(box.hi.y, y1, 1e-4);
}

const std::string rectangle = "<rect x=\"2\" y=\"2\" width=\"10\" height=\"4\"/>";

#ifdef OMBRE_3MF

TEST(Svg, PlacesAsInOpenScad) {
  expect_box(svg("width=\"20mm\" height=\"10mm\" viewBox=\"0 0 40 20\"", rectangle).box, 1, 6, 7, 9);
  expect_box(svg("width=\"200\" height=\"100\"", rectangle).box, 2, 12, 29.2778, 33.2778);
  expect_box(svg("", rectangle).box, 2, 12, -6, -2);
  expect_box(svg("viewBox=\"1 1 40 20\"", rectangle).box, 0.352768, 3.88055, 4.58611, 5.99721);
  PlaneOptions options;
  options.dots_per_inch = 96;
  expect_box(svg("width=\"200\" height=\"100\"", rectangle, options).box, 2, 12, 20.4583, 24.4583);
}

TEST(Svg, TransformsAndGroups) {
  const std::string page = "width=\"20mm\" height=\"10mm\" viewBox=\"1 1 40 20\"";
  expect_box(svg(page, "<g transform=\"translate(3,1) scale(2)\"><path d=\"M0 0 h4 v2 h-4 z\"/></g>").box, 1, 5, 7, 9);
  const Measured turned = svg("viewBox=\"0 0 9 9\" width=\"9mm\" height=\"9mm\"",
                              "<g transform=\"rotate(90 4 4)\"><rect x=\"4\" y=\"3\" width=\"4\" height=\"1\"/></g>");
  EXPECT_NEAR(std::abs(turned.area), 4, 1e-12);
  expect_box(turned.box, 4, 5, 1, 5);
}

TEST(Svg, Shapes) {
  const std::string page = "viewBox=\"0 0 20 20\" width=\"20mm\" height=\"20mm\"";
  const double n = 40, polygon = 0.5 * n * std::sin(2 * std::numbers::pi / n);
  EXPECT_NEAR(std::abs(svg(page, "<circle cx=\"5\" cy=\"5\" r=\"3\"/>").area), 9 * polygon, 1e-9);
  EXPECT_NEAR(std::abs(svg(page, "<ellipse cx=\"5\" cy=\"5\" rx=\"3\" ry=\"2\"/>").area), 6 * polygon, 1e-9);
  EXPECT_NEAR(std::abs(svg(page, "<polygon points=\"0,0 4,0 0 3\"/>").area), 6, 1e-12);
  // Chords of a point-symmetric curve remove as much area as they add.
  EXPECT_NEAR(std::abs(svg(page, "<path d=\"M0 0 C 5 0 5 5 10 5 L 0 5 z\"/>").area), 25, 1e-9);
  EXPECT_NEAR(std::abs(svg(page, "<path d=\"M 5 10 A 5 3 0 0 1 15 10 z\"/>").area), 7.5 * polygon, 1e-9);
  EXPECT_NEAR(std::abs(svg(page, "<path d=\"M5,10a5,3,0,0110,0z\"/>").area), 7.5 * polygon, 1e-9);
  EXPECT_NEAR(std::abs(svg(page, "<rect x=\"1\" y=\"1\" width=\"6\" height=\"4\" rx=\"1\"/>").area), 20 + polygon,
              1e-9);
  EXPECT_NEAR(std::abs(svg(page, "<path d=\"M0 0Q2 4 4 0z\"/>").area), 16.0 / 3, 0.02);
  const Measured two = svg(page, "<path d=\"M0 0 h10 v10 h-10 z M2 2 h3 v3 h-3 z\"/>" + rectangle);
  EXPECT_EQ(two.shapes, 2U);
  EXPECT_EQ(two.rings, 3U);
}

TEST(Svg, OneElement) {
  PlaneOptions options;
  options.id = "b";
  const std::string content = "<g id=\"a\">" + rectangle + "</g><g id=\"b\"><circle r=\"1\"/></g>";
  EXPECT_EQ(svg("", content, options).shapes, 1U);
}

TEST(Svg, WhatIsWrong) {
  const auto message = [](const std::string& text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_svg("test.svg", text, {}, diagnostics));
    return diagnostics.list().empty() ? "" : diagnostics.list()[0].message;
  };
  EXPECT_EQ(message(svg_of("", "<path d=\"M0 0 L 3\"/>")), "a number is missing after 'L'");
  EXPECT_EQ(message(svg_of("", "<path d=\"M0 0 X 3\"/>")), "'X' is no command of a path");
  EXPECT_NE(message("<html/>"), "");
  EXPECT_NE(message("M0 0"), "");
}

TEST(Svg, StrokesAreLeftOut) {
  Diagnostics diagnostics;
  const auto shapes = read_svg("test.svg", svg_of("", "<line x1=\"0\" y1=\"0\" x2=\"5\" y2=\"5\"/>"), {}, diagnostics);
  ASSERT_TRUE(shapes);
  EXPECT_TRUE(shapes->shapes.empty());
  EXPECT_EQ(diagnostics.list().size(), 1U);
}

TEST(Svg, WhatIsWrittenIsReadAgain) {
  const std::vector<DrawnRegion> regions{{"a \"b\"", Rgba{255, 0, 0, 128}, {{{0, 0}, {4, 0}, {4, 3}}}},
                                         {"", {}, {{{10, 10}, {14, 10}, {14, 13}, {10, 13}}}}};
  const std::string text = drawing_svg("t", regions);
  EXPECT_NE(text.find("class=\"a &quot;b&quot;\""), std::string::npos);
  EXPECT_NE(text.find("fill=\"#FF0000\""), std::string::npos);
  Diagnostics diagnostics;
  const auto shapes = read_svg("test.svg", text, {}, diagnostics);
  ASSERT_TRUE(shapes);
  EXPECT_NEAR(std::abs(measured(*shapes).area), 18, 1e-6);
}

#endif

std::string dxf_of(const std::string& entities, const std::string& blocks = "") {
  return "0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

Measured dxf(const std::string& text, const PlaneOptions& options = {}) {
  Diagnostics diagnostics;
  const auto shapes = read_dxf("test.dxf", text, options, diagnostics);
  EXPECT_TRUE(shapes) << to_text(diagnostics);
  return shapes ? measured(*shapes) : Measured{};
}

std::string line(double x0, double y0, double x1, double y1, const std::string& layer = "0") {
  const auto text = [](double v) { return std::to_string(v) + "\n"; };
  return "0\nLINE\n8\n" + layer + "\n10\n" + text(x0) + "20\n" + text(y0) + "11\n" + text(x1) + "21\n" + text(y1);
}

TEST(Dxf, LinesBecomeRings) {
  const std::string square = line(0, 0, 4, 0) + line(4, 3, 4, 0) + line(0, 3, 4, 3) + line(0, 3, 0, 0);
  EXPECT_NEAR(std::abs(dxf(dxf_of(square)).area), 12, 1e-9);
  Diagnostics diagnostics;
  EXPECT_TRUE(read_dxf("test.dxf", dxf_of(square + line(9, 9, 8, 8)), {}, diagnostics));
  ASSERT_EQ(diagnostics.list().size(), 1U);
  EXPECT_EQ(diagnostics.list()[0].message, "left out of the drawing: 1 lines that enclose nothing");
  Diagnostics of_chain;
  EXPECT_TRUE(read_dxf("test.dxf", dxf_of(square + line(9, 9, 8, 8) + line(8, 8, 8, 9)), {}, of_chain));
  ASSERT_EQ(of_chain.list().size(), 1U);
  EXPECT_EQ(of_chain.list()[0].message,
            "1 chains of lines do not close within 0.0009; a straight line joins the ends of each, at most 1 long");
}

TEST(Dxf, ArcsAndBulges) {
  const double n = 40, polygon = 0.5 * n * std::sin(2 * std::numbers::pi / n);
  EXPECT_NEAR(std::abs(dxf(dxf_of("0\nCIRCLE\n10\n1\n20\n2\n40\n3\n")).area), 9 * polygon, 1e-9);
  EXPECT_NEAR(std::abs(dxf(dxf_of("0\nARC\n10\n0\n20\n0\n40\n2\n50\n0\n51\n180\n" + line(2, 0, -2, 0))).area),
              2 * polygon, 1e-5);
  EXPECT_NEAR(std::abs(dxf(dxf_of("0\nELLIPSE\n10\n0\n20\n0\n11\n0\n21\n3\n40\n0.5\n")).area), 4.5 * polygon, 1e-9);
  // The ring consists of two half circles.
  const std::string round = "0\nLWPOLYLINE\n90\n2\n70\n1\n10\n-2\n20\n0\n42\n1\n10\n2\n20\n0\n42\n1\n";
  EXPECT_NEAR(dxf(dxf_of(round)).area, 4 * polygon, 1e-9);
  const std::string old =
      "0\nPOLYLINE\n70\n1\n0\nVERTEX\n10\n0\n20\n0\n0\nVERTEX\n10\n4\n20\n0\n0\nVERTEX\n10\n0\n20\n3\n"
      "0\nSEQEND\n";
  EXPECT_NEAR(dxf(dxf_of(old)).area, 6, 1e-9);
}

TEST(Dxf, LayersAndBlocks) {
  const auto triangle = [](const std::string& layer) {
    return line(0, 0, 1, 0, layer) + line(1, 0, 0, 1, layer) + line(0, 1, 0, 0, layer);
  };
  PlaneOptions options;
  options.layer = "b";
  EXPECT_EQ(dxf(dxf_of(triangle("a") + triangle("b")), options).rings, 1U);
  const std::string block = "0\nBLOCK\n2\nT\n10\n1\n20\n0\n" + triangle("0") + "0\nENDBLK\n";
  const Measured used = dxf(dxf_of("0\nINSERT\n2\nT\n10\n5\n20\n5\n41\n2\n42\n3\n", block));
  EXPECT_NEAR(std::abs(used.area), 3, 1e-9);
  expect_box(used.box, 3, 5, 5, 8);
}

TEST(Dxf, WhatIsWrong) {
  const auto message = [](const std::string& text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_dxf("test.dxf", text, {}, diagnostics));
    return diagnostics.list().empty() ? "" : diagnostics.list()[0].message;
  };
  EXPECT_EQ(message(""), "there is no section ENTITIES");
  EXPECT_EQ(message("solid x\n"), "a group code is expected, a whole number, not \"solid x\"");
  EXPECT_EQ(message(dxf_of("0\nLINE\n10\nx\n")), "a number is expected for code 10, not \"x\"");
}

TEST(Dxf, WhatIsWrittenIsReadAgain) {
  const std::vector<DrawnRegion> regions{{"a", {}, {{{0, 0}, {4, 0}, {4, 3}}}}, {"", {}, {{{9, 9}, {10, 9}, {9, 10}}}}};
  EXPECT_NEAR(dxf(drawing_dxf(regions)).area, 6.5, 1e-6);
  PlaneOptions options;
  options.layer = "a";
  EXPECT_NEAR(dxf(drawing_dxf(regions), options).area, 6, 1e-6);
}

}  // namespace
}  // namespace ombre::formats
