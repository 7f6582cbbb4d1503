// Areas of drawings that are imported, from mathematics and from the specifications SVG 1.1, CSS 2.1 and DXF.
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "base/math/math.h"
#include "base/system/temporary_folder.h"
#include "formats/drawings/plane_writers.h"
#include "solids/files.h"
#include "solids/test_kernel.h"

namespace ombre::solids::drawings {
namespace {

constexpr double pi = std::numbers::pi;

struct Drawn {
  double area = 0;
  Box box;
  Diagnostics messages;
};

Drawn drawn(const std::string& name, const std::string& text, Import import = {}) {
  const TemporaryFolder folder;
  import.path = folder.file(name);
  import.fragments = {64};
  std::ofstream(import.path, std::ios::binary) << text;
  Drawn result;
  for (const Piece& piece : import_pieces(import, {}, result.messages))
    if (const Region* region = piece.region())
      for (const Ring& ring : region->rings) {
        result.area += doubled_area(ring) / 2;
        for (const Vec2& p : ring) result.box = hull(result.box, Box{{p.x, p.y, 0}, {p.x, p.y, 0}});
      }
  return result;
}

bool mentions(const Drawn& drawing, const std::string& words) {
  return to_text(drawing.messages).find(words) != std::string::npos;
}

#define EXPECT_MENTIONS(drawing, words) EXPECT_TRUE(mentions(drawing, words)) << to_text((drawing).messages)

class Drawings : public KernelTest {};

const std::string page = R"(width="100mm" height="100mm" viewBox="0 0 100 100")";

Drawn svg(const std::string& content, const Import& import = {}, const std::string& attributes = page) {
  return drawn("a.svg",
               "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" " + attributes +
                   ">" + content + "</svg>",
               import);
}

double svg_area(const std::string& content, const std::string& attributes = page) {
  const Drawn drawing = svg(content, {}, attributes);
  EXPECT_FALSE(drawing.messages.has_errors()) << to_text(drawing.messages);
  return drawing.area;
}

#define EXPECT_AREA(area, expected) EXPECT_NEAR(area, expected, 1e-5)

TEST_F(Drawings, FillRules) {
  const std::string same_turn = R"( d="M 0 0 H 20 V 20 H 0 Z M 5 5 H 15 V 15 H 5 Z"/>)";
  EXPECT_AREA(svg_area("<path" + same_turn), 400);
  EXPECT_AREA(svg_area("<path fill-rule=\"nonzero\"" + same_turn), 400);
  EXPECT_AREA(svg_area("<path fill-rule=\"evenodd\"" + same_turn), 300);
  EXPECT_AREA(svg_area("<g style=\"fill-rule:evenodd\"><path" + same_turn + "</g>"), 300);
  EXPECT_AREA(svg_area(R"(<path d="M 0 0 H 20 V 20 H 0 Z M 5 5 V 15 H 15 V 5 Z"/>)"), 300);
}

TEST_F(Drawings, KeepTheirAspect) {
  const std::string square = R"(<rect x="40" y="40" width="20" height="20"/>)";
  const auto in_page = [&](const std::string& aspect) {
    return svg_area(square, R"(width="200mm" height="100mm" viewBox="0 0 100 100")" + aspect);
  };
  EXPECT_AREA(in_page(""), 400);
  EXPECT_AREA(in_page(R"( preserveAspectRatio="xMinYMax meet")"), 400);
  EXPECT_AREA(in_page(R"( preserveAspectRatio="xMidYMid slice")"), 1600);
  EXPECT_AREA(in_page(R"( preserveAspectRatio="none")"), 800);
  EXPECT_AREA(svg_area(square, R"(width="200mm" viewBox="0 0 100 100")"), 1600);
  const Drawn middle = svg(square, {}, R"(width="200mm" height="100mm" viewBox="0 0 100 100")");
  EXPECT_NEAR(middle.box.lo.x, 90, 1e-6);
  const Drawn right =
      svg(square, {}, R"(width="200mm" height="100mm" viewBox="0 0 100 100" preserveAspectRatio="xMaxYMid")");
  EXPECT_NEAR(right.box.lo.x, 140, 1e-6);
}

TEST_F(Drawings, Percentages) {
  EXPECT_AREA(svg_area(R"(<rect width="50%" height="20%"/>)"), 1000);
  EXPECT_AREA(svg_area(R"(<rect x="10%" width="10%" height="10%"/>)", R"(width="40mm" height="30mm")"), 12);
  const double n = 40, polygon = 0.5 * n * std::sin(2 * pi / n);
  // 100 % of a radius is the diagonal divided by the root of 2.
  EXPECT_AREA(svg_area(R"(<circle cx="50%" cy="50%" r="10%"/>)"), 100 * polygon);
  EXPECT_TRUE(svg(R"(<rect width="50%" height="2"/>)", {}, "").messages.has_errors());
  EXPECT_TRUE(svg(R"(<rect width="5em" height="2"/>)").messages.has_errors());
}

TEST_F(Drawings, OpenLinesAreStrokes) {
  EXPECT_AREA(svg_area(R"(<polyline points="10,10 60,10 60,60" fill="none" stroke="black" stroke-width="4"/>)"), 400);
  EXPECT_AREA(svg_area(R"(<line x1="10" y1="10" x2="30" y2="10" stroke="red" stroke-width="2"/>)"), 40);
  const std::string thick = R"(<path d="M10 10H30" style="fill:none;stroke:red;stroke-width:2)";
  EXPECT_AREA(svg_area(thick + R"(;stroke-linecap:square"/>)"), 44);
  // A closed path without a length shows its caps, one of two points its joins.
  EXPECT_AREA(svg_area(R"(<path d="M10 10z" fill="none" stroke="red" stroke-linecap="square" stroke-width="3"/>)"), 9);
  EXPECT_NEAR(svg_area(R"(<path d="M10 10h9z" fill="none" stroke="red" stroke-linejoin="round" stroke-width="2"/>)"),
              18 + pi, 0.02);
  // A right angle has a tip of 2 x 2 mm, or half of it if its length of 1.414 widths is beyond the limit.
  const std::string corner = R"(<path d="M10 10H30V30" style="fill:none;stroke:red;stroke-width:4)";
  EXPECT_AREA(svg_area(corner + R"("/>)"), 160);
  EXPECT_AREA(svg_area(corner + R"(;stroke-linejoin:bevel"/>)"), 158);
  EXPECT_AREA(svg_area(corner + R"(;stroke-miterlimit:1.4"/>)"), 158);
  const double round = svg_area(thick + R"(;stroke-linecap:round"/>)");
  EXPECT_GT(round, 40 + 0.8 * pi);
  EXPECT_LT(round, 40 + pi);
  EXPECT_AREA(svg_area(R"(<g transform='scale(2)'><path d="M1 1H11" fill="none" stroke="red"/></g>)"), 40);
  EXPECT_AREA(svg_area(R"(<g transform='scale(2 1)'><path d="M1 1H11" fill="none" stroke="red"/></g>)"), 20);
  const Drawn nothing = svg(R"(<line x1="10" y1="10" x2="30" y2="10"/><text>a</text><image/><text>b</text>)");
  EXPECT_EQ(nothing.area, 0);
  EXPECT_MENTIONS(nothing, "1 images, 1 outlines without a fill and a stroke, 2 texts");
  EXPECT_MENTIONS(nothing, "encloses no area");
}

TEST_F(Drawings, AreReadAsPaintedOnRequest) {
  const std::string frame =
      R"(<rect x="10" y="10" width="20" height="20" fill="none" stroke="black" stroke-width="2"/>)";
  const Drawn filled = svg(frame);
  EXPECT_AREA(filled.area, 400);
  EXPECT_MENTIONS(filled, "1 closed outlines have no fill");
  Import painted;
  painted.is_painted = true;
  EXPECT_AREA(svg(frame, painted).area, 22 * 22 - 18 * 18);
  EXPECT_AREA(svg(R"(<rect x="10" y="10" width="20" height="20" stroke="black" stroke-width="2"/>)", painted).area,
              22 * 22);
  EXPECT_AREA(svg(R"(<rect x="10" y="10" width="20" height="20" fill="none"/>)", painted).area, 0);
}

TEST_F(Drawings, StyleGoesBeforeAttributes) {
  const std::string square = R"(<rect width="10" height="10")";
  EXPECT_AREA(svg_area(square + R"( display="none" style="display:inline"/>)"), 100);
  EXPECT_AREA(svg_area(square + R"( display="inline" style="display : none"/>)"), 0);
  EXPECT_AREA(svg_area(square + R"( visibility="hidden"/>)"), 0);
  EXPECT_AREA(svg_area("<g visibility=\"hidden\">" + square + "/>" + square + R"( x="20" visibility="visible"/></g>)"),
              100);
  EXPECT_AREA(svg_area("<g display=\"none\">" + square + R"( display="inline"/></g>)"), 0);
  const auto with = [&](const std::string& sheet) {
    return svg_area("<style>/* a */" + sheet + "</style><g id=\"g\">" + square + R"( id="a" class="b c"/></g>)");
  };
  EXPECT_AREA(with("rect{display:none}"), 0);
  EXPECT_AREA(with(".d, .c{display:none}"), 0);
  EXPECT_AREA(with("circle, .d, #b{display:none}"), 100);
  EXPECT_AREA(with("rect{display:none} .b{display:inline}"), 100);
  EXPECT_AREA(with(".b{display:inline} rect{display:none}"), 100);
  EXPECT_AREA(with("#a{display:none} .b.c{display:inline}"), 0);
  EXPECT_AREA(with("rect{display:none !important} #a{display:inline}"), 0);
  EXPECT_AREA(with("#g rect{display:none}"), 0);
  EXPECT_AREA(with("g > rect.b{display:none}"), 0);
  EXPECT_AREA(with("svg > rect{display:none}"), 100);
  EXPECT_AREA(with("@font-face{font-family:x} rect:hover{display:none}"), 100);
  EXPECT_TRUE(svg("<style>rect[x]{display:none}</style>" + square + "/>").messages.has_errors());
  EXPECT_AREA(svg_area("<style><![CDATA[ .a { width: 5px } ]]></style>" + square + R"( class="a"/>)"), 50);
}

TEST_F(Drawings, Uses) {
  EXPECT_AREA(svg_area(R"(<defs><path id="p" d="M 0 0 H 10 V 10 H 0 Z"/></defs>
<rect x="70" y="70" width="10" height="10"/><use xlink:href="#p" transform='translate(5 5)'/>
<use href="#p" x="40" y="20"/>)"),
              300);
  const std::string symbol = R"(<symbol id="s" viewBox="0 0 10 10"><rect width="5" height="10"/></symbol>)";
  EXPECT_AREA(svg_area(symbol + R"(<use href="#s" width="20" height="20"/>)"), 200);
  EXPECT_AREA(svg_area(symbol), 0);
  EXPECT_AREA(
      svg_area(R"(<g id="a"><rect width="1" height="1"/></g><g id="b"><use href="#a" x="10"/><use href="#a" x="20"/></g>
<use href="#b" y="10"/>)"),
      5);
  EXPECT_TRUE(svg(R"(<g id="a"><use href="#a"/></g>)").messages.has_errors());
  EXPECT_TRUE(svg(R"(<use href="#missing"/>)").messages.has_errors());
  EXPECT_TRUE(svg(R"(<use href="other.svg#a"/>)").messages.has_errors());
}

TEST_F(Drawings, NestedPicturesAndClips) {
  EXPECT_AREA(
      svg_area(R"(<svg x="10" y="10" width="40" height="20" viewBox="0 0 10 10"><rect width="10" height="10"/></svg>)"),
      400);
  EXPECT_AREA(svg_area(R"(<svg x="10" y="10" width="5" height="5"><rect width="10" height="10"/></svg>)"), 25);
  EXPECT_AREA(svg_area(R"(<svg width="5" height="5" overflow="visible"><rect width="10" height="10"/></svg>)"), 100);
  EXPECT_AREA(svg_area(R"(<clipPath id="c"><rect width="5" height="7"/></clipPath>
<g transform='scale(2)'><rect width="10" height="10" clip-path='url(#c)'/></g>)"),
              140);
  EXPECT_TRUE(svg(R"(<mask id="m"/><rect width="5" height="7" mask='url(#m)'/>)").messages.has_errors());
  EXPECT_AREA(svg_area(R"(<switch><rect requiredExtensions="x" width="9" height="9"/><rect width="2" height="1"/>
<rect width="9" height="9"/></switch>)"),
              2);
}

TEST_F(Drawings, AreaFollowsTheDeterminant) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int round = 0; round < 20; ++round) {
    const double a = number(random), b = number(random), c = number(random), d = number(random);
    Ring ring;
    std::string points, map = "matrix(";
    for (int n = 0; n < 7; ++n) {
      const double radius = 4 + number(random), angle = 2 * pi * n / 7;
      ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      points += std::to_string(ring.back().x) + "," + std::to_string(ring.back().y) + " ";
    }
    for (const double v : {a, b, c, d}) map += std::to_string(v) + " ";
    const double area = std::abs(doubled_area(ring) / 2), determinant = std::abs(a * d - b * c);
    EXPECT_NEAR(svg_area("<polygon points=\"" + points + "\"/>"), area, 1e-4);
    EXPECT_NEAR(svg_area("<g transform=\"" + map + "3 4)\"><polygon points=\"" + points + "\"/></g>"),
                area * determinant, 1e-3);
  }
}

std::string entity(const std::string& kind, const std::vector<std::pair<int, double>>& values) {
  std::string text = "0\n" + kind + "\n8\n0\n";
  for (const auto& [code, value] : values) text += std::to_string(code) + "\n" + std::to_string(value) + "\n";
  return text;
}

std::string line(double x0, double y0, double x1, double y1) {
  return entity("LINE", {{10, x0}, {20, y0}, {11, x1}, {21, y1}});
}

std::string square(double x, double y, double size) {
  return line(x, y, x + size, y) + line(x + size, y, x + size, y + size) + line(x + size, y + size, x, y + size) +
         line(x, y + size, x, y);
}

Drawn dxf(const std::string& entities, const std::string& blocks = "", const Import& import = {}) {
  return drawn(
      "a.dxf",
      "0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n",
      import);
}

TEST_F(Drawings, EndsMeetWithinATolerance) {
  // The ends differ by less than the tolerance, on both sides of a cell's border.
  const Drawn joined = dxf(line(0.0005, 0, 10, 0) + line(10.0000004, 0.0000004, 10, 10) + line(10, 9.9996, 0, 10) +
                           line(-0.0003, 10.0004, 0.0005, -0.0004));
  EXPECT_NEAR(joined.area, 100, 0.01);
  EXPECT_MENTIONS(joined, "apart are joined; the tolerance is 0.001");
  const Drawn open = dxf(line(0, 0, 10, 0) + line(10, 0, 10, 10) + line(10, 10, 0, 10) + line(0, 10, 0, 2));
  EXPECT_AREA(open.area, 100);
  EXPECT_MENTIONS(open, "1 chains of lines do not close");
  EXPECT_MENTIONS(open, "at most 2 long");
}

TEST_F(Drawings, DoubledLinesCountOnce) {
  EXPECT_AREA(dxf(square(0, 0, 10) + square(0, 0, 10)).area, 100);
  EXPECT_AREA(dxf(square(0, 0, 10) + line(10, 0, 0, 0)).area, 100);
  const std::string closed =
      "0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n10\n10\n20\n0\n10\n10\n20\n10\n10\n0\n20\n10\n";
  EXPECT_AREA(dxf(closed + square(0, 0, 10)).area, 100);
  // The halves of a square agree in their boxes and areas, but not in their centres.
  const auto triangle = [](const std::string& corners) { return "0\nLWPOLYLINE\n8\n0\n70\n1\n" + corners; };
  EXPECT_AREA(dxf(triangle("10\n0\n20\n0\n10\n10\n20\n0\n10\n0\n20\n10\n") +
                  triangle("10\n10\n20\n10\n10\n0\n20\n10\n10\n10\n20\n0\n"))
                  .area,
              100);
}

TEST_F(Drawings, ExtrusionsMirror) {
  // A normal along -z mirrors x (DXF reference, arbitrary axis algorithm).
  const Drawn circle = dxf(entity("CIRCLE", {{10, 20}, {20, 5}, {40, 2}, {210, 0}, {220, 0}, {230, -1}}));
  EXPECT_NEAR(circle.box.center().x, -20, 1e-6);
  EXPECT_NEAR(circle.box.center().y, 5, 1e-6);
  const Drawn half = dxf(entity("ARC", {{10, 20}, {20, 0}, {40, 2}, {50, 0}, {51, 90}, {230, -1}}) +
                         line(-22, 0, -20, 0) + line(-20, 0, -20, 2));
  EXPECT_NEAR(half.area, pi, 0.2);
  EXPECT_NEAR(half.box.lo.x, -22, 1e-6);
  // The minor axis of an ellipse is the normal times the major axis: this half lies below.
  const Drawn ellipse =
      dxf(entity("ELLIPSE", {{10, 0}, {20, 0}, {11, 4}, {21, 0}, {40, 0.5}, {41, 0}, {42, pi}, {230, -1}}) +
          line(-4, 0, 4, 0));
  EXPECT_NEAR(ellipse.box.lo.y, -2, 0.05);
  EXPECT_NEAR(ellipse.box.hi.y, 0, 1e-6);
}

TEST_F(Drawings, Splines) {
  std::vector<std::pair<int, double>> cubic{{70, 8}, {71, 3}};
  for (const double parameter : {0, 0, 0, 0, 1, 1, 1, 1}) cubic.emplace_back(40, parameter);
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{{0, 0}, {0, 4}, {6, 4}, {6, 0}}) {
    cubic.emplace_back(10, x);
    cubic.emplace_back(20, y);
  }
  // The integral of y dx over this Bezier curve is 3/5 of the area of its control polygon, 24.
  EXPECT_NEAR(dxf(entity("SPLINE", cubic) + line(6, 0, 0, 0)).area, 14.4, 0.01);
  // A quarter of a circle is a rational spline of degree 2.
  std::vector<std::pair<int, double>> quarter{{70, 4}, {71, 2}};
  for (const double parameter : {0, 0, 0, 1, 1, 1}) quarter.emplace_back(40, parameter);
  for (const double weight : {1.0, std::sqrt(0.5), 1.0}) quarter.emplace_back(41, weight);
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{{10, 0}, {10, 10}, {0, 10}}) {
    quarter.emplace_back(10, x);
    quarter.emplace_back(20, y);
  }
  EXPECT_NEAR(dxf(entity("SPLINE", quarter) + line(0, 10, 0, 0) + line(0, 0, 10, 0)).area, 25 * pi, 0.01);
  // A closed curve through eight points of a circle.
  std::vector<std::pair<int, double>> round{{70, 1}, {71, 3}};
  for (int n = 0; n <= 8; ++n) {
    round.emplace_back(11, 10 * std::cos(n * pi / 4));
    round.emplace_back(21, 10 * std::sin(n * pi / 4));
  }
  EXPECT_NEAR(dxf(entity("SPLINE", round)).area, 100 * pi, 1);
  EXPECT_TRUE(dxf(entity("SPLINE", {{71, 3}, {10, 1}, {20, 1}})).messages.has_errors());
}

TEST_F(Drawings, ArraysOfBlocks) {
  const std::string block = "0\nBLOCK\n2\nB\n10\n1\n20\n1\n" + square(1, 1, 2) + "0\nENDBLK\n";
  const auto insert = [](const std::string& values) { return "0\nINSERT\n8\n0\n2\nB\n" + values; };
  const Drawn array = dxf(insert("10\n0\n20\n0\n70\n3\n71\n2\n44\n10\n45\n20\n"), block);
  EXPECT_AREA(array.area, 24);
  EXPECT_NEAR(array.box.hi.x, 22, 1e-6);
  EXPECT_NEAR(array.box.hi.y, 22, 1e-6);
  const Drawn turned = dxf(insert("10\n0\n20\n0\n50\n90\n41\n2\n70\n2\n44\n10\n"), block);
  EXPECT_AREA(turned.area, 16);
  EXPECT_NEAR(turned.box.hi.y, 14, 1e-6);
  EXPECT_NEAR(turned.box.lo.x, -2, 1e-6);
  const std::string outer =
      block + "0\nBLOCK\n2\nO\n10\n0\n20\n0\n" + insert("10\n1\n20\n0\n") + insert("10\n9\n20\n0\n") + "0\nENDBLK\n";
  EXPECT_AREA(dxf("0\nINSERT\n8\n0\n2\nO\n10\n0\n20\n0\n41\n-1\n42\n2\n", outer).area, 16);
  EXPECT_MENTIONS(dxf("0\nINSERT\n8\n0\n2\nMISSING\n" + square(0, 0, 1)), "missing blocks");
  const std::string itself = "0\nBLOCK\n2\nB\n10\n0\n20\n0\n" + insert("10\n1\n20\n0\n") + "0\nENDBLK\n";
  EXPECT_TRUE(dxf(insert("10\n0\n20\n0\n"), itself).messages.has_errors());
}

TEST_F(Drawings, PaperSpaceIsLeftOut) {
  const std::string frame = "0\nLWPOLYLINE\n8\n0\n67\n1\n70\n1\n10\n50\n20\n0\n10\n60\n20\n0\n10\n60\n20\n9\n";
  EXPECT_AREA(dxf(square(0, 0, 10) + frame).area, 100);
}

TEST_F(Drawings, HatchesAreAreasWhereNothingElseIs) {
  const std::string border =
      "0\nHATCH\n8\n0\n10\n0\n20\n0\n2\nSOLID\n70\n1\n91\n1\n92\n3\n72\n0\n73\n1\n93\n4\n"
      "10\n0\n20\n0\n10\n10\n20\n0\n10\n10\n20\n10\n10\n0\n20\n10\n97\n0\n75\n0\n98\n1\n10\n5\n20\n5\n";
  EXPECT_AREA(dxf(border).area, 100);
  EXPECT_AREA(dxf(border + square(-5, -5, 30)).area, 900);
  EXPECT_AREA(dxf(border + square(20, 20, 3)).area, 109);
  const std::string edges =
      "0\nHATCH\n8\n0\n91\n1\n92\n1\n93\n2\n72\n2\n10\n0\n20\n0\n40\n10\n50\n0\n51\n180\n73\n1\n"
      "72\n1\n10\n-10\n20\n0\n11\n10\n21\n0\n97\n0\n75\n0\n";
  EXPECT_NEAR(dxf(edges).area, 50 * pi, 4);
  EXPECT_AREA(dxf(entity("SOLID", {{10, 0}, {20, 0}, {11, 4}, {21, 0}, {12, 0}, {22, 3}, {13, 4}, {23, 3}})).area, 12);
}

TEST_F(Drawings, SayWhatTheyAre) {
  const std::string text = "0\nSECTION\n2\nENTITIES\n" + square(0, 0, 10) + "0\nENDSEC\n0\nEOF\n";
  EXPECT_AREA(drawn("a.dxf", "\xEF\xBB\xBF" + text).area, 100);
  EXPECT_MENTIONS(drawn("a.dxf", "AutoCAD Binary DXF\r\n\x1A"), "binary form");
  EXPECT_MENTIONS(drawn("a.dxf", "AC1032"), "DWG");
  const Drawn texts = dxf(entity("TEXT", {}) + entity("TEXT", {}) + entity("DIMENSION", {}) + line(0, 0, 1, 1));
  EXPECT_MENTIONS(texts, "encloses no area; it holds 1 DIMENSION, 2 TEXT, 1 lines that enclose nothing");
}

TEST_F(Drawings, AreEqualAfterWriting) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> radius(2, 9);
  for (int round = 0; round < 10; ++round) {
    Ring ring;
    for (int n = 0; n < 12; ++n) {
      const double r = radius(random), angle = 2 * pi * n / 12;
      ring.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    const std::vector<formats::DrawnRegion> regions{{"a", {}, {ring}}};
    const double area = doubled_area(ring) / 2;
    EXPECT_NEAR(drawn("a.dxf", formats::drawing_dxf(regions)).area, area, 1e-4);
    EXPECT_NEAR(drawn("a.svg", formats::drawing_svg("", regions)).area, area, 1e-4);
  }
}

}  // namespace
}  // namespace ombre::solids::drawings
