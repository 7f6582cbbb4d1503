// Tests what is said of the struts of designs, whose numbers follow from the geometry of cells.
#include "jobs/characterise/strut_graphs.h"

#include <cmath>

#include "jobs/mesh/beam_parts.h"
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

std::vector<LatticeGraph> graphs_of(const std::string& text) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  EXPECT_TRUE(loaded) << to_text(diagnostics);
  return loaded ? lattice_graphs_of(loaded->design) : std::vector<LatticeGraph>{};
}

LatticeGraph only_graph(const std::string& text) {
  const std::vector<LatticeGraph> graphs = graphs_of(text);
  EXPECT_EQ(graphs.size(), 1u);
  return graphs.empty() ? LatticeGraph{} : graphs[0];
}

using Degrees = std::map<size_t, size_t>;

void expect_graph(const LatticeGraph& found, size_t joints, size_t struts, const Degrees& degrees) {
  EXPECT_EQ(found.graph.joints, joints) << found.text();
  EXPECT_EQ(found.graph.struts, struts) << found.text();
  EXPECT_EQ(found.graph.joints_of_degree, degrees) << found.text();
}

void expect_lengths(const LatticeGraph& found, double least, double greatest) {
  EXPECT_TRUE(found.knows_lengths()) << found.text();
  EXPECT_NEAR(found.graph.length.least, least, 1e-9) << found.text();
  EXPECT_NEAR(found.graph.length.greatest, greatest, 1e-9) << found.text();
}

void expect_slenderness(const LatticeGraph& found, double slenderness) {
  EXPECT_TRUE(found.knows_slenderness()) << found.text();
  EXPECT_NEAR(found.graph.slenderness.least, slenderness, 1e-9) << found.text();
  EXPECT_NEAR(found.graph.slenderness.greatest, slenderness, 1e-9) << found.text();
}

const std::string on_boxes = "map=box_cells((6, 6, 6), min=(0, 0, 0), max=(6, 6, 6))";
const double half_diagonal = 3 * std::sqrt(3);  // of a cell of 6 mm

}  // namespace

TEST(StrutGraphs, AreThoseOfTheDesignsFrame) {
  const LatticeGraph twice = only_graph("scale(2, 2, 2) lattice(\"bcc\", radius=0.3, " + on_boxes + ");");
  expect_graph(twice, 2, 8, {{8, 2}});
  expect_lengths(twice, 2 * half_diagonal, 2 * half_diagonal);
  expect_slenderness(twice, 2 * half_diagonal / 0.3);
  const LatticeGraph tall = only_graph("translate(1, 2, 3) scale(1, 1, 2) lattice(\"cubic\", (6, 6, 6), 0.3);");
  expect_graph(tall, 1, 3, {{6, 1}});
  expect_lengths(tall, 6, 12);
  EXPECT_EQ(tall.no_slenderness, "the scale is not the same along all axes");
  // Turned about z by 45 degrees, diagonals of faces lie along x and y.
  const LatticeGraph turned = only_graph(
      "scale(3, 1, 1) rotate(0, 0, 45) lattice(edges=[[(0, 0, 0), (4, 4, 0)], [(0, 0, 0), (4, -4, 0)]], radius=0.3);");
  expect_lengths(turned, 4 * std::sqrt(2), 3 * 4 * std::sqrt(2));
}

TEST(StrutGraphs, HaveTheStepsOfTiles) {
  const LatticeGraph apart = only_graph("tile((12, 12, 12)) lattice(\"bcc\", (6, 6, 6), 0.3);");
  expect_graph(apart, 9, 8, {{1, 8}, {8, 1}});
  EXPECT_EQ(apart.maxwell_of_cell, 8 - 3 * 9 + 6);
  for (const char* inner : {"", "rotate(0, 90, 0) ", "translate(1, 2, 3) ", "mirror((1, 0, 0)) "})
    expect_graph(only_graph(std::string("tile((6, 6, 6)) ") + inner + "lattice(\"bcc\", (6, 6, 6), 0.3);"), 2, 8,
                 {{8, 2}});
  const LatticeGraph inside =
      only_graph("scale(2, 2, 2) tile((6, 6, 6)) scale(2, 2, 2) lattice(\"bcc\", (3, 3, 3), 0.3);");
  expect_graph(inside, 2, 8, {{8, 2}});
  expect_lengths(inside, 2 * half_diagonal, 2 * half_diagonal);
  expect_slenderness(inside, 2 * 2 * half_diagonal / 1.2);
  // A layer of cells: its corners have four struts.
  const LatticeGraph layer = only_graph("tile((6, 6, 0)) lattice(\"bcc\", (6, 6, 6), 0.3);");
  expect_graph(layer, 3, 8, {{4, 2}, {8, 1}});
  // Tiles along different axes repeat together, and a tile with one copy along z does not repeat along it.
  expect_graph(only_graph("tile((0, 0, 6)) tile((6, 6, 0)) lattice(\"bcc\", (6, 6, 6), 0.3);"), 2, 8, {{8, 2}});
  expect_graph(only_graph("tile((6, 6, 6), (0, 0, 0), (3, 3, 0)) lattice(\"bcc\", (6, 6, 6), 0.3);"), 3, 8,
               {{4, 2}, {8, 1}});
}

TEST(StrutGraphs, OfTrussesOfTheLibrary) {
  const std::string use = "use <ombre/cellular.vcad>\nintersection() { cube(18); ";
  const LatticeGraph pyramids = only_graph(use + "pyramidal_truss(6, 5, 0.5); }");
  expect_graph(pyramids, 2, 4, {{4, 2}});
  expect_lengths(pyramids, std::sqrt(9 + 9 + 25), std::sqrt(9 + 9 + 25));
  // Three struts cross at two places of each period, and three end at each of two corners of triangles above and below.
  const LatticeGraph kagome = only_graph(use + "kagome_truss(6, 5, 0.5); }");
  expect_graph(kagome, 6, 12, {{3, 4}, {6, 2}});
  expect_lengths(kagome, std::sqrt(12 + 6.25), std::sqrt(12 + 6.25));
}

TEST(StrutGraphs, LinesThatCloseHaveAJoint) {
  const LatticeGraph line = only_graph(
      "lattice(edges=[[(0, 0.5, 0.5), (1, 0.5, 0.5)]], radius=0.5, map=box_cells((6, 6, 6), min=(0, 0, 0), max=(12, "
      "12, "
      "12)));");
  expect_graph(line, 1, 1, {{2, 1}});
  expect_lengths(line, 6, 6);
  expect_slenderness(line, 24);
}

TEST(StrutGraphs, KnowStrutsWithBallsAndFillets) {
  for (const char* more : {"joint=1, ", "blend=0.2, ", "joint=\"1 + 0.01*x\", blend=0.2, "}) {
    const LatticeGraph found = only_graph(std::string("lattice(\"bcc\", radius=0.5, ") + more + on_boxes + ");");
    expect_graph(found, 2, 8, {{8, 2}});
    expect_lengths(found, half_diagonal, half_diagonal);
    expect_slenderness(found, 2 * half_diagonal / 0.5);
  }
  const LatticeGraph graded = only_graph("lattice(\"bcc\", radius=\"0.5 + 0.01*x\", joint=1, " + on_boxes + ");");
  expect_lengths(graded, half_diagonal, half_diagonal);
  EXPECT_EQ(graded.no_slenderness, "radii vary");
  // A point in a tetrahedron is joined to its corners.
  const std::string points = "[(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6), (1, 1, 1)]";
  for (const char* more : {"closed=true", "blend=0.2"}) {
    const LatticeGraph found = only_graph("delaunay_struts(" + points + ", 0.5, region=sphere(9), " + more + ");");
    expect_graph(found, 5, 10, {{4, 5}});
    expect_lengths(found, std::sqrt(3), 6 * std::sqrt(2));
    EXPECT_NEAR(found.graph.slenderness.least, 2 * std::sqrt(3) / 0.5, 1e-9);
  }
  const LatticeGraph bent =
      only_graph("lattice(\"bcc\", radius=0.3, map=cylinder_cells(8, 12, 20, count=(12, 4, 1)));");
  expect_graph(bent, 2, 8, {{8, 2}});
  EXPECT_EQ(bent.no_lengths, "cells are bent");
}

TEST(StrutGraphs, HaveNoStrutsOutsideOfARegion) {
  const std::string foam =
      "voronoi_struts(scattered_points(sphere(8), distance=3).points, 0.3, region=sphere(2), material=\"red\");";
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(foam, diagnostics);
  const auto parts = loaded ? split_beams(loaded->design, 1, diagnostics) : std::nullopt;
  ASSERT_TRUE(parts) << to_text(diagnostics);
  EXPECT_EQ(only_graph(foam).graph.struts, parts->sets.at(0).struts.size());
  // The radius is a formula whose greatest value in the region is that of the others.
  const std::string graded =
      "voronoi_struts(scattered_points(sphere(8), distance=3).points, \"0.28 + 0.01*x\", region=sphere(2));";
  const LatticeGraph of_formula = only_graph(graded);
  EXPECT_EQ(of_formula.graph.struts, only_graph(foam).graph.struts);
  EXPECT_EQ(of_formula.no_slenderness, "radii vary");
  // The region leaves out the struts of the far tetrahedron, but none between both.
  const std::string two =
      "delaunay_struts([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (50, 51, 52), (51, 51, 52.1), (50, 52, 52.2), "
      "(50.1, "
      "51.2, 53)], 0.1";
  const size_t whole = only_graph(two + ");").graph.struts,
               kept = only_graph(two + ", region=sphere(3));").graph.struts;
  EXPECT_EQ(whole, kept + 6);
}

TEST(StrutGraphs, SayWhatIsNotKnown) {
  const std::string bcc = "lattice(\"bcc\", (6, 6, 6), 0.3);";
  const LatticeGraph twisted = only_graph("twist(10) " + bcc);
  expect_graph(twisted, 2, 8, {{8, 2}});
  EXPECT_EQ(twisted.no_lengths, "\"twist\" may change them");
  EXPECT_NE(twisted.text().find("8 at each; lengths are left out, because \"twist\" may change them; Maxwell"),
            std::string::npos)
      << twisted.text();
  const LatticeGraph thicker = only_graph("offset(0.1) " + bcc);
  expect_lengths(thicker, half_diagonal, half_diagonal);
  EXPECT_EQ(thicker.no_slenderness, "\"offset\" may change them");
  EXPECT_NE(thicker.text().find("5.196 mm long; slenderness is left out, because \"offset\""), std::string::npos)
      << thicker.text();
  for (const char* above : {"array_grid((2, 2, 2), (9, 9, 9)) ", "negate() ", "union(blend=1) "})
    expect_slenderness(only_graph(above + bcc), 2 * half_diagonal / 0.3);
}

// Equal calls make one node.
TEST(StrutGraphs, AreThereOnceForEachSize) {
  const std::vector<LatticeGraph> graphs = graphs_of(
      "module a() lattice(\"bcc\", (6, 6, 6), 0.3);\n"
      "a(); translate(9, 0, 0) a(); rotate(1, 2, 3) a(); mirror((1, 2, 3)) a(); translate(30, 0, 0) scale(2, 2, 2) "
      "a();");
  ASSERT_EQ(graphs.size(), 2u);
  expect_lengths(graphs[0], half_diagonal, half_diagonal);
  expect_lengths(graphs[1], 2 * half_diagonal, 2 * half_diagonal);
}

// Each module has the one before twice, beside itself and turned: there are 2^12 lattices of one size. A scale in place
// of the turn makes thirteen sizes. A hundred sizes are told apart.
TEST(StrutGraphs, OfManyUsesAreFound) {
  const auto nested = [](const std::string& first, const std::string& second, int depth) {
    std::string text = "module a0() lattice(\"bcc\", (6, 6, 6), 0.3);\n";
    for (int n = 1; n <= depth; ++n) {
      const std::string below = " a" + std::to_string(n - 1) + "();";
      text += "module a" + std::to_string(n) + "() { " + first + below + ' ' + second + below + " }\n";
    }
    return text + "a" + std::to_string(depth) + "();";
  };
  EXPECT_EQ(graphs_of(nested("translate(9, 0, 0)", "rotate(10, 20, 30)", 12)).size(), 1u);
  EXPECT_EQ(graphs_of(nested("translate(9, 0, 0)", "scale(2, 2, 2)", 12)).size(), 13u);
  const std::vector<LatticeGraph> many =
      graphs_of("for (n = [1 : 150]) scale(1 + n/10, 1, 1) lattice(\"bcc\", (6, 6, 6), 0.3);");
  ASSERT_EQ(many.size(), 101u);
  EXPECT_EQ(many[100].no_lengths, "they are used in more than a hundred ways");
}

}  // namespace ombre::compile
