// Tests which struts of designs become beams; their numbers were counted by hand.
#include "jobs/mesh/beam_parts.h"

#include <algorithm>
#include <cmath>

#include "jobs/mesh/beam_bodies.h"
#include "jobs/test_designs.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

struct Found {
  LoadedPtr loaded;
  std::optional<BeamParts> parts;
  std::string messages;
};

Found split_text(const std::string& text) {
  Diagnostics diagnostics;
  Found found;
  found.loaded = load_text(text, diagnostics);
  if (found.loaded) found.parts = split_beams(found.loaded->design, 1, diagnostics);
  found.messages = to_text(diagnostics);
  return found;
}

// Returns the only set of beams of a design that has nothing else.
BeamSet only_set(const std::string& text) {
  const Found found = split_text(text);
  EXPECT_EQ(found.messages, "");
  EXPECT_TRUE(found.parts && found.parts->sets.size() == 1 && !found.parts->rest);
  return found.parts ? found.parts->sets.at(0) : BeamSet{};
}

Box bounds(const design::NodePtr& node) { return node ? node->bounds(design::design_space()) : Box::empty(); }

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z; }

void expect_near(const Box& a, const Box& b) {
  expect_near(a.lo, b.lo);
  expect_near(a.hi, b.hi);
}

void expect_lost(const std::string& text, const std::string& message) {
  const Found found = split_text("union() { lattice(edges=[[(50, 0, 0), (60, 0, 0)]], radius=1); " + text + " }");
  ASSERT_TRUE(found.parts) << found.messages;
  ASSERT_EQ(found.parts->sets.size(), 1u);
  EXPECT_EQ(found.parts->sets[0].struts.size(), 1u);
  EXPECT_TRUE(found.parts->rest);
  EXPECT_NE(found.messages.find(message), std::string::npos) << found.messages;
}

}  // namespace

TEST(BeamParts, ABodyCentredCellIsEightHalfDiagonals) {
  const BeamSet set = only_set("lattice(\"bcc\", (4, 6, 8), 0.5);");
  ASSERT_EQ(set.struts.size(), 8u);
  std::vector<std::array<double, 3>> corners;
  for (const nodes::StrutShape& strut : set.struts) {
    expect_near(strut.start, {0, 0, 0});
    corners.push_back({std::abs(strut.end.x), std::abs(strut.end.y), std::abs(strut.end.z)});
    EXPECT_EQ(strut.start_radius, 0.5);
    EXPECT_EQ(strut.end_radius, 0.5);
  }
  EXPECT_EQ(std::ranges::count(corners, std::array<double, 3>{2, 3, 4}), 8);
}

TEST(BeamParts, SimilaritiesMoveThem) {
  const BeamSet set = only_set(
      "translate(1, 2, 3) rotate(0, 0, 90) scale(2, -2, 2) fgrade([\"1\"], [\"red\"])"
      " attribute(\"a\", 1) lattice(edges=[[(1, 0, 0), (1, 4, 5)]], radius=\"0.5 + (2 - t)/4\");");
  ASSERT_EQ(set.struts.size(), 1u);
  // (x, y, z) becomes (2x, -2y, 2z), and that (2y, 2x, 2z).
  expect_near(set.struts[0].start, Vec3{1, 2, 3} + Vec3{0, 2, 0});
  expect_near(set.struts[0].end, Vec3{1, 2, 3} + Vec3{8, 2, 10});
  EXPECT_DOUBLE_EQ(set.struts[0].start_radius, 2 * 1);
  EXPECT_DOUBLE_EQ(set.struts[0].end_radius, 2 * 0.75);
  EXPECT_FALSE(set.clip);
}

TEST(BeamParts, EdgesMayHaveRadiiOfTheirOwn) {
  const BeamSet set =
      only_set("lattice(edges=[[(0, 0, 0), (1, 0, 0), 0.3], [(0, 0, 0), (0, 1, 0), 0.2]], radius=\"x\");");
  ASSERT_EQ(set.struts.size(), 2u);
  EXPECT_EQ(set.struts[1].end_radius, 0.2);
}

TEST(BeamParts, StrutsOneByOneHaveTheirCaps) {
  const BeamBody body =
      beams_of(only_set("union() { strut((0, 0, 0), (9, 0, 0), 1); strut((0, 0, 0), (9, 0, 0), 1, caps=\"round\");"
                        " strut((0, 0, 0), (9, 0, 0), \"1 + t\", caps=\"round\"); strut((9, 0, 0), (0, 0, 0), 1); }"));
  ASSERT_EQ(body.beams.size(), 3u);
  EXPECT_EQ(body.beams[0].caps[0], formats::BeamCap::butt);
  EXPECT_EQ(body.beams[1].caps[0], formats::BeamCap::sphere);
  EXPECT_EQ(body.beams[2].caps[1], formats::BeamCap::hemisphere);
  EXPECT_EQ(body.beams[2].radii, (std::array<double, 2>{1, 2}));
}

TEST(BeamParts, TilesAreEnumeratedAndJoined) {
  // The vertices are centres, and corners of a grid of 4 x 3 x 2 cells.
  const BeamBody bcc =
      beams_of(only_set("tile((0.1, 0.3, 0.7), (0, -1, 5), (3, 1, 6)) scale(0.1, 0.1, 0.1)"
                        " rotate(0, 90, 0) lattice(\"bcc\", (7, 3, 1), 0.2);"));
  EXPECT_EQ(bcc.beams.size(), 8u * 24);
  EXPECT_EQ(bcc.vertices.size(), 24u + 5 * 4 * 3);
  // The struts are halves of edges: along an axis there are n at (n + 1)^2 places. Each cell has 24, many of which it
  // shares.
  const BeamBody cubic = beams_of(only_set("tile((5, 5, 5), (0, 0, 0), (2, 2, 2)) lattice(\"cubic\", (5, 5, 5), 1);"));
  EXPECT_EQ(cubic.beams.size(), 2u * 3 * 3 * 16);
  EXPECT_EQ(cubic.vertices.size(), 64u + 3 * 3 * 16);
}

TEST(BeamParts, CellsThatAreBoxesAreEnumerated) {
  const BeamSet set =
      only_set("lattice(\"bcc\", radius=0.3, map=box_cells((4, 4, 5), min=(1, 0, 0), max=(9, 12, 10)));");
  EXPECT_EQ(set.struts.size(), 8u * 2 * 3 * 2);
  EXPECT_EQ(set.clipping, formats::LatticeClipping::inside);
  expect_near(bounds(set.clip), Box{{1, 0, 0}, {9, 12, 10}});
  const BeamBody body = beams_of(set);
  EXPECT_EQ(body.vertices.size(), 12u + 3 * 4 * 3);
  for (const nodes::StrutShape& strut : set.struts)
    EXPECT_NEAR(length(strut.end - strut.start), std::sqrt(4 + 4 + 6.25), 1e-12);
}

// Struts that are no mirror images reach in from the cells around.
TEST(BeamParts, GraphsReachInFromNeighbours) {
  const BeamSet set = only_set(
      "lattice(edges=[[(0, 0, 0), (1, 1, 1)]], radius=0.5, map=box_cells((4, 4, 4), min=(0, 0, 0), max=(8, 8, 8)));");
  // The struts of the cells -1 and 2 count if they touch the box.
  const auto has_corner = [&](Vec3 corner) {
    return std::ranges::any_of(set.struts, [&](const auto& strut) { return length(strut.start - corner) < 1e-12; });
  };
  EXPECT_TRUE(has_corner({4, 4, 4}));
  EXPECT_TRUE(has_corner({-4, -4, -4}));
  EXPECT_TRUE(has_corner({8, 8, 8}));
  EXPECT_FALSE(has_corner({12, 12, 12}));
}

TEST(BeamParts, CellsWithoutEndAreCutByOthers) {
  const BeamSet set = only_set(
      "intersection() { translate(4, 4, 4) rectprism((7.9, 7.9, 7.9)); lattice(\"bcc\", radius=\"0.3 - 0.1*t\","
      " map=box_cells((4, 4, 4))); }");
  // There are 2 cells along each axis and halves of the next ones.
  EXPECT_EQ(beams_of(set).beams.size(), 8u * 2 * 2 * 2 + 6u * 4 * 2 * 2 + 12u * 2 * 2 + 8u);
  EXPECT_DOUBLE_EQ(set.struts[0].end_radius, 0.2);
}

TEST(BeamParts, StrutsBetweenPointsAreBeams) {
  // The corners of a tetrahedron, and a point in it.
  const std::string points = "points=[(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6), (1, 1, 1)], radius=0.5";
  EXPECT_EQ(only_set("delaunay_struts(" + points + ");").struts.size(), 10u);
  const BeamSet cut = only_set("translate(1, 0, 0) delaunay_struts(" + points + ", region=sphere(5));");
  EXPECT_EQ(cut.struts.size(), 10u);
  EXPECT_EQ(cut.clipping, formats::LatticeClipping::inside);
  expect_near(bounds(cut.clip), Box{{-4, -5, -5}, {6, 5, 5}});
  // Around the middle of eight corners and itself there is a truncated octahedron: 36 edges.
  const BeamSet foam = only_set(
      "voronoi_struts(points=[for (i = [-2:2], j = [-2:2], k = [-2:2], h = [0, 2]) [4*i + h, 4*j + h, 4*k + h]],"
      " radius=0.1, region=rectprism((4, 4, 4)));");
  EXPECT_GE(foam.struts.size(), 36u);
  for (const nodes::StrutShape& strut : foam.struts) EXPECT_LT(length(strut.end - strut.start), std::sqrt(2) + 1e-9);
}

TEST(BeamParts, SaysWhyStrutsAreNoBeams) {
  expect_lost("lattice(\"bcc\", radius=0.3, map=cylinder_cells(8, 12, 20, count=(12, 4, 1)));", "no equal boxes");
  expect_lost("lattice(\"bcc\", radius=0.3, joint=0.5, map=box_cells((4, 4, 4), min=(0, 0, 0), max=(8, 8, 8)));",
              "balls at their ends");
  expect_lost(
      "delaunay_struts([(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6), (1, 1, 1)], 0.5, region=sphere(5), closed=true);",
      "10 struts are written as triangles, because struts along the surface of a region are not straight");
}

TEST(BeamParts, BeamsOfOtherRadiiStay) {
  const BeamBody body = beams_of(only_set(
      "lattice(edges=[[(0, 0, 0), (1, 0, 0), 0.3], [(1, 0, 0), (0, 0, 0), 0.2], [(1, 0, 0), (0, 0, 0), 0.3]]);"));
  ASSERT_EQ(body.beams.size(), 2u);
  EXPECT_EQ(body.vertices.size(), 2u);
  EXPECT_EQ(body.beams[0].radii[0], 0.3);
  EXPECT_EQ(body.beams[1].ends, (std::array<uint32_t, 2>{1, 0}));
}

TEST(BeamParts, AnIntersectionKeepsTheInside) {
  // The struts of the next cells begin at x = 5 - 0.4.
  const BeamSet set =
      only_set("intersection() { rectprism((9, 9, 9)); tile() lattice(\"bcc\", (10, 10, 10), 0.4); cube(9.1); }");
  EXPECT_EQ(set.struts.size(), 8u);
  EXPECT_EQ(set.clipping, formats::LatticeClipping::inside);
  expect_near(bounds(set.clip), Box::centered({4.5, 4.5, 4.5}));
}

TEST(BeamParts, StrutsBesideARoundClipAreLeftOut) {
  const auto count = [](const std::string& clip) {
    return only_set("intersection() { " + clip + " tile() lattice(\"bcc\", (1, 1, 1), 0.01); }").struts.size();
  };
  const size_t cube = count("cube(9.9);"), sphere = count("sphere(4.95);");
  // There are 9 cells along each axis and halves of the next ones.
  EXPECT_EQ(cube, 8u * 9 * 9 * 9 + 6u * 4 * 9 * 9 + 12u * 2 * 9 + 8u);
  // There are 8 struts in each mm3: all whose middle lies in the ball, and none that lies farther away than it is long.
  const auto in_ball = [](double radius) { return 8 * 4.18879 * radius * radius * radius; };
  EXPECT_GT(static_cast<double>(sphere), in_ball(4.95));
  EXPECT_LT(static_cast<double>(sphere), in_ball(4.95 + 0.01 + std::sqrt(3) / 4));
}

TEST(BeamParts, ADifferenceKeepsTheOutside) {
  const BeamSet set = only_set(
      "translate(10, 0, 0) difference() { lattice(\"bcc\", (4, 4, 4), 0.5); sphere(1); translate(2, 0, 0) sphere(1); "
      "}");
  EXPECT_EQ(set.struts.size(), 8u);
  EXPECT_EQ(set.clipping, formats::LatticeClipping::outside);
  expect_near(bounds(set.clip), {{9, -1, -1}, {13, 1, 1}});
}

TEST(BeamParts, ClipsCombine) {
  const std::string bcc = "lattice(\"bcc\", (4, 4, 4), 0.5);";
  const BeamSet within = only_set("intersection() { cube(3); intersection() { sphere(2); " + bcc + " } }");
  EXPECT_EQ(within.clipping, formats::LatticeClipping::inside);
  expect_near(bounds(within.clip), Box::centered({1.5, 1.5, 1.5}));
  const BeamSet both = only_set("difference() { intersection() { sphere(2); " + bcc + " } sphere(1); }");
  EXPECT_EQ(both.clipping, formats::LatticeClipping::inside);
  expect_near(bounds(both.clip), Box::centered({2, 2, 2}));
  const BeamSet without = only_set("difference() { difference() { " + bcc + " sphere(1); } cube(0.5); }");
  EXPECT_EQ(without.clipping, formats::LatticeClipping::outside);
  const BeamSet negated = only_set("intersection() { negate() sphere(1); " + bcc + " }");
  EXPECT_EQ(negated.clipping, formats::LatticeClipping::outside);
  expect_near(bounds(negated.clip), Box::centered({1, 1, 1}));
}

TEST(BeamParts, TheBoxOfRootCuts) {
  const BeamSet cut = only_set("root((-1, -1, -1), (1, 1, 1), (0.1, 0.1, 0.1)) lattice(\"bcc\", (4, 4, 4), 0.5);");
  EXPECT_EQ(cut.clipping, formats::LatticeClipping::inside);
  expect_near(bounds(cut.clip), Box::centered({1, 1, 1}));
  EXPECT_FALSE(only_set("root((-3, -3, -3), (3, 3, 3), (0.1, 0.1, 0.1)) lattice(\"bcc\", (4, 4, 4), 0.5);").clip);
}

TEST(BeamParts, TheRestIsWhatElseThereIs) {
  const Found found = split_text(
      "difference() { translate(0, 0, 5) union() { sphere(2); lattice(\"bcc\", (9, 9, 9), 0.5); cube(3); }"
      " translate(0, 0, 6) cube(4); }");
  ASSERT_TRUE(found.parts) << found.messages;
  ASSERT_EQ(found.parts->sets.size(), 1u);
  EXPECT_EQ(found.parts->sets[0].struts.size(), 8u);
  expect_near(bounds(found.parts->rest), {{-2, -2, 3}, {2, 2, 7}});
  EXPECT_EQ(found.parts->rest->inputs()[0]->inputs()[0]->inputs().size(), 2u);
}

TEST(BeamParts, StrutsOfOneClipAreTogether) {
  const Found found = split_text(
      "union() { lattice(\"bcc\", (4, 4, 4), 0.5); difference() { union() { lattice(\"bcc\", (4, 4, 4), 0.5);"
      " translate(4, 0, 0) lattice(\"bcc\", (4, 4, 4), 0.5); } sphere(1); } translate(9, 0, 0)"
      " lattice(\"bcc\", (4, 4, 4), 0.5); }");
  ASSERT_TRUE(found.parts) << found.messages;
  ASSERT_EQ(found.parts->sets.size(), 2u);
  EXPECT_EQ(found.parts->sets[0].struts.size(), 16u);
  EXPECT_EQ(found.parts->sets[1].struts.size(), 16u);
}

TEST(BeamParts, WhatIsNoBeamIsCountedWithItsReason) {
  const std::string bcc = "lattice(\"bcc\", (4, 4, 4), 0.5);";
  expect_lost("offset(0.1) " + bcc,
              "8 struts are written as triangles, because beams cannot have the shape that "
              "\"offset\" makes of them");
  expect_lost("offset(0.1) { tile((4, 4, 4), (0, 0, 0), (1, 2, 3)) " + bcc + " }", "192 struts are");
  expect_lost("scale(1, 1, 2) " + bcc,
              "8 struts are written as triangles, because beams cannot have the shape that "
              "\"scale\"");
  expect_lost("union(blend=1) { sphere(1); " + bcc + " }", "8 struts are");
  expect_lost("intersection() { " + bcc + bcc + " }", "16 struts are");
  expect_lost("difference() { cube(3); " + bcc + " }", "8 struts are");
  expect_lost("tile((9, 9, 9), (0, 0, 0), (1, 1, 1)) { sphere(1); " + bcc + " }", "64 struts are");
  expect_lost("lattice(edges=[[(0, 0, 0), (4, 0, 0)]], radius=\"1 + 0.1*x\");",
              "1 strut is written as triangles, because the radius of the struts varies by place");
  expect_lost("lattice(edges=[[(0, 0, 0), (4, 0, 0)]], radius=\"1 + t*t\");",
              "1 strut is written as triangles, because the radius is not linear along the struts");
  for (const char* made :
       {"lattice(edges=[[(0, 0, 0), (4, 0, 0)]], radius=\"0.5*t\");", "strut((0, 0, 0), (4, 0, 0), \"1 - t\");"})
    expect_lost(made, "1 strut is written as triangles, because the radius is not above 0 at both ends of the struts");
  expect_lost(
      "tile((9, 9, 9), (0, 0, 0), (1, 1, 1)) lattice(edges=[[(0, 0, 0), (4, 0, 0)]], radius=\"1 + 0.1*clamp(0, ci, "
      "1)\");",
      "8 struts are written as triangles, because the radius of the struts varies by place");
}

// A strut, and eight copies of a lattice whose struts are not counted.
TEST(BeamParts, LatticesOnMapsAreNamedBesideTheCount) {
  const std::string strut = "strut((30, 0, 0), (40, 0, 0), \"1 + 0.1*sin(t)\");";
  const std::string lattice =
      "lattice(\"bcc\", radius=\"0.3 + 0.1*sin(t)\", map=box_cells((4, 4, 4), min=(0, 0, 0), max=(8, 8, 8)));";
  const std::string why = " written as triangles, because the radius is not linear along the struts";
  expect_lost(strut, "1 strut is" + why);
  expect_lost(lattice, "warning: struts are" + why);
  expect_lost(strut + lattice, "1 strut and those of maps of cells are" + why);
  expect_lost(lattice + strut + strut, "2 struts and those of maps of cells are" + why);
}

// Nothing is written then.
TEST(BeamParts, NothingBecomesTrianglesWhereThereAreNoBeams) {
  const Found found = split_text("offset(0.1) lattice(\"bcc\", (4, 4, 4), 0.5);");
  EXPECT_FALSE(found.parts);
  EXPECT_NE(found.messages.find("8 struts are no beams, because beams cannot have the shape that \"offset\" makes"),
            std::string::npos)
      << found.messages;
  EXPECT_EQ(found.messages.find("triangles"), std::string::npos) << found.messages;
  EXPECT_NE(found.messages.find("struts are what lattice, strut, voronoi_struts and delaunay_struts make"),
            std::string::npos)
      << found.messages;
}

TEST(BeamParts, DesignsWithoutStrutsAreAnError) {
  const Found found = split_text("sphere(3);");
  EXPECT_FALSE(found.parts);
  EXPECT_NE(found.messages.find("error: the design has no struts that can be written as beams; leave --beams out"),
            std::string::npos)
      << found.messages;
}

TEST(BeamParts, TooManyStrutsAreAnErrorBeforeTheyAreMade) {
  const Found found = split_text("intersection() { cube(1000); tile() lattice(\"bcc\", (0.1, 0.1, 0.1), 0.01); }");
  EXPECT_FALSE(found.parts);
  EXPECT_NE(found.messages.find("more than 100,000,000 struts"), std::string::npos) << found.messages;
}

TEST(BeamMaterials, AreThoseInTheMiddleOfAxes) {
  Diagnostics diagnostics;
  // The design is red from x = 0 to 4, blue beyond: the first strut is red throughout, the second more blue than red.
  const LoadedPtr loaded = load_text(
      "fgrade([\"x < 4\", \"x >= 4\"], [\"red\", \"blue\"]) lattice(edges=[[(0, 0, 0), (3, 0, 0)], [(3, 0, 0), (9, 0, "
      "0)], [(0, 5, 0), (3, 5, 0)], [(8, 5, 0), (8, 9, 0)]], radius=0.5);",
      diagnostics);
  ASSERT_TRUE(loaded) << to_text(diagnostics);
  const auto parts = split_beams(loaded->design, 1, diagnostics);
  ASSERT_TRUE(parts);
  BeamBody body = beams_of(parts->sets[0]);
  EXPECT_EQ(add_materials(loaded->design, 1, body, diagnostics), 1u);
  const MaterialId red = loaded->design.materials.find("red")->id, blue = loaded->design.materials.find("blue")->id;
  EXPECT_EQ(body.materials, (std::vector<MaterialId>{red, blue, red, blue}));
}

}  // namespace ombre::compile
