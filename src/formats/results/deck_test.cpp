// Tests decks: assemblies, systems, generators, included files, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/math/box.h"
#include "formats/results/results.h"

namespace ombre::formats {
namespace {

const std::string cube_nodes =
    "1, 0, 0, 0\n2, 10, 0, 0\n3, 10, 10, 0\n4, 0, 10, 0\n5, 0, 0, 10\n6, 10, 0, 10\n7, 10, 10, 10\n8, 0, 10, 10\n";
const std::string cube_element = "1, 1, 2, 3, 4, 5, 6, 7, 8\n";
const std::string cube = "*NODE\n" + cube_nodes + "*ELEMENT, TYPE=C3D8\n" + cube_element;

struct Deck {
  std::optional<Results> results;
  std::string said;

  explicit Deck(const std::string& text, const std::vector<ResultsFile>& named = {},
                const std::optional<ResultsFile>& values = {}) {
    Diagnostics diagnostics;
    results = read_results("a.inp", text, {values, named}, diagnostics);
    said = to_text(diagnostics);
  }

  size_t elements() const { return results ? results->kinds.size() : 0; }
  Box box_of(size_t element) const {
    Box box;
    for (size_t n = 0; n < node_count(results->kinds[element]); ++n) {
      const Vec3 p = results->points[results->nodes[results->first[element] + n]];
      box = hull(box, Box{p, p});
    }
    return box;
  }
};

void expect_box(const Box& box, Vec3 lo, Vec3 hi) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.lo[axis], lo[axis], 1e-9);
    EXPECT_NEAR(box.hi[axis], hi[axis], 1e-9);
  }
}

// Checks that the deck is one cube of 10 mm whose least corner is this.
void expect_cube(const std::string& text, Vec3 lo = {}) {
  const Deck deck(text);
  ASSERT_EQ(deck.elements(), 1U) << deck.said << text;
  expect_box(deck.box_of(0), lo, lo + Vec3{10, 10, 10});
}

void expect_refused(const std::string& text, const std::string& what) {
  const Deck deck(text);
  EXPECT_FALSE(deck.results) << text;
  EXPECT_NE(deck.said.find(what), std::string::npos) << deck.said;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST(Decks, AreReadInAllSpellings) {
  expect_cube("\xEF\xBB\xBF" + cube);
  expect_cube(replaced(cube, "1, 0, 0, 0", "1, , , 0"));
  expect_cube(replaced(cube, "2, 10, 0, 0", "2, 1.0D+01, 0, 0."));
  expect_cube(replaced(cube, "2, 10, 0, 0", "2, 1.0+1"));
  expect_cube(replaced(cube, "TYPE=C3D8", "ELSET=body,\n  TYPE = C3D8"));
  expect_cube("*ELEMENT, TYPE=C3D8\n" + cube_element + "* NODE , NSET=all\n" + cube_nodes);
  expect_cube(replaced(cube, "1, 1, 2, 3, 4, 5,", "1, 1, 2, 3, 4,\n5,"));
  expect_cube(replaced(cube, "1, 0, 0, 0", "1"));
  expect_cube(replaced(cube, "*ELEMENT, TYPE=C3D8", "*ELEMENT\t,\tTYPE\t=\tC3D8"));
  std::string of_old_macs = cube;
  std::ranges::replace(of_old_macs, '\n', '\r');
  expect_cube(of_old_macs);
  expect_refused(replaced(cube, "TYPE=C3D8", "ELSET=body"), "expected the type of the elements");
}

TEST(Decks, NodesMayComeTwiceAtOnePlace) {
  expect_cube(cube + "*NODE\n1, 0, 0, 0\n");
  expect_refused(cube + "*NODE\n1, 0, 0, 1\n", "node 1 comes twice, at different places");
}

TEST(Decks, SolidFamiliesAreBricks) {
  for (const char* type : {"C3D8R", "DC3D8", "SC8R", "COH3D8", "GK3D8", "c3d8i"})
    expect_cube(replaced(cube, "C3D8", type));
  for (const char* type : {"M3D8", "SFM3D8", "CONN3D2"})
    expect_refused(replaced(cube, "C3D8", type), "(" + std::string(type) + ") are left out");
  expect_refused(replaced(cube, "C3D8", "C3D27"), "elements of the type \"c3d27\" are not read");
}

TEST(Decks, InstancesAreMovedAndTurned) {
  const std::string part = "*PART, NAME=block\n" + cube + "*END PART\n*ASSEMBLY, NAME=all\n";
  const Deck deck(
      part + "*INSTANCE, NAME=a, PART=Block\n*END INSTANCE\n*INSTANCE, NAME=b, PART=block\n20.\n" +
      // The turn about the z axis through (20, 0, 0) takes x from 20 ... 30 to y from 0 ... 10, and y to -x.
      "*END INSTANCE\n*INSTANCE, NAME=c, PART=block\n20., 0., 0.\n20, 0, 0, 20, 0, 1, 90\n*END INSTANCE\n"
      "*END ASSEMBLY\n");
  ASSERT_EQ(deck.elements(), 3U) << deck.said;
  expect_box(deck.box_of(0), {0, 0, 0}, {10, 10, 10});
  expect_box(deck.box_of(1), {20, 0, 0}, {30, 10, 10});
  expect_box(deck.box_of(2), {10, 0, 0}, {20, 10, 10});
  // The first line of the instance is blank.
  const Deck turned(part + "*INSTANCE, NAME=a, PART=block\n\n0, 0, 0, 0, 0, 1, 90\n*END INSTANCE\n*END ASSEMBLY\n");
  ASSERT_EQ(turned.elements(), 1U) << turned.said;
  expect_box(turned.box_of(0), {-10, 0, 0}, {0, 10, 10});
  expect_refused(part + "*INSTANCE, NAME=a, PART=rod\n*END INSTANCE\n", "a.inp:15:1: error: there is no part \"rod\"");
  expect_refused(part + "*INSTANCE, LIBRARY=old, INSTANCE=a\n", "comes from another analysis");
}

TEST(Decks, PartsMayShareNumbers) {
  const std::string parts =
      "*PART, NAME=a\n" + cube + "*END PART\n*PART, NAME=b\n*SYSTEM\n20, 0, 0\n" + cube + "*END PART\n";
  const Deck both(parts);
  ASSERT_EQ(both.elements(), 2U) << both.said;
  expect_box(both.box_of(1), {20, 0, 0}, {30, 10, 10});
  const Deck one(parts + "*ASSEMBLY, NAME=all\n*INSTANCE, NAME=b-1, PART=b\n*END INSTANCE\n*END ASSEMBLY\n");
  ASSERT_EQ(one.elements(), 1U) << one.said;
  EXPECT_NE(one.said.find("1 parts of which the assembly has no instance are left out"), std::string::npos) << one.said;
  const Deck with_values(parts, {}, ResultsFile{"a.csv", "node,v\n1,2\n"});
  EXPECT_NE(with_values.said.find("a number may stand for several nodes"), std::string::npos) << with_values.said;
}

TEST(Decks, MeshesMayStandInTheInstance) {
  const Deck deck("*PART, NAME=a\n*END PART\n*ASSEMBLY, NAME=all\n*INSTANCE, NAME=a-1, PART=a\n5, 0, 0\n" + cube +
                  "*END INSTANCE\n*END ASSEMBLY\n");
  ASSERT_EQ(deck.elements(), 1U) << deck.said;
  expect_box(deck.box_of(0), {5, 0, 0}, {15, 10, 10});
}

TEST(Decks, SystemsHoldForTheNodesThatFollow) {
  expect_cube("*SYSTEM\n100., 0., 0.\n" + cube, {100, 0, 0});
  expect_cube("*SYSTEM\n100., 0., 0.\n*SYSTEM\n" + cube);
  // The x axis of the system is y, its y axis is -x.
  expect_cube("*SYSTEM\n0, 0, 0, 0, 1, 0\n-1, 0, 0\n" + cube, {-10, 0, 0});
  expect_refused("*SYSTEM\n0, 0, 0, 1, 0, 0\n2, 0, 0\n" + cube, "lie on a line");
}

TEST(Decks, NodesMayBeCylindricalAndSpherical) {
  const Deck round(
      "*NODE, SYSTEM=C\n1, 2, 90, 3\n*NODE, SYSTEM=S\n2, 2, 90, 30\n*NODE\n3, 5\n4, 0, 5\n"
      "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n");
  ASSERT_TRUE(round.results) << round.said;
  EXPECT_NEAR(length(round.results->points[0] - Vec3{0, 2, 3}), 0, 1e-12);
  EXPECT_NEAR(length(round.results->points[1] - Vec3{0, std::sqrt(3.0), 1}), 0, 1e-12);
  expect_refused("*NODE, SYSTEM=Q\n1, 0, 0, 0\n", "expected SYSTEM=R, C or S");
}

// A bar of four bricks from its two end faces.
TEST(Decks, GeneratorsMakeNodesAndElements) {
  const std::string ends =
      "*NODE, NSET=left\n1, 0, 0, 0\n2, 0, 1, 0\n3, 0, 1, 1\n4, 0, 0, 1\n*NODE, NSET=right\n41, 4, 0, 0\n42, 4, 1, 0\n"
      "43, 4, 1, 1\n44, 4, 0, 1\n";
  const std::string bricks = "*ELEMENT, TYPE=C3D8, ELSET=all\n1, 1, 11, 12, 2, 4, 14, 13, 3\n";
  const std::string row = "*ELGEN, ELSET=all\n1, 4, 10, 1\n";
  for (const std::string& between : {std::string("*NFILL\nleft, right, 4, 10\n"),
                                     std::string("*NGEN\n1, 41, 10\n2, 42, 10\n3, 43, 10\n4, 44, 10\n")}) {
    const Deck deck(ends + between + bricks + row);
    ASSERT_EQ(deck.elements(), 4U) << deck.said;
    for (size_t n = 0; n < 4; ++n) {
      const auto x = static_cast<double>(n);
      expect_box(deck.box_of(n), {x, 0, 0}, {x + 1, 1, 1});
    }
  }
  const Deck copied(ends + "*NFILL, NSET=middle\nleft, right, 4, 10\n" + bricks + row +
                    "*NSET, NSET=every\nleft, middle, right\n"
                    "*NCOPY, CHANGE NUMBER=100, OLD SET=every, SHIFT, NEW SET=far\n0, 5, 0\n"
                    "*ELCOPY, ELEMENT SHIFT=10, OLD SET=all, SHIFT NODES=100\n");
  ASSERT_EQ(copied.elements(), 8U) << copied.said;
  expect_box(copied.box_of(7), {3, 5, 0}, {4, 6, 1});
  expect_refused(ends + "*NGEN, LINE=C\n1, 41, 10\n", "*ngen with line is not read");
  expect_refused(ends + "*NGEN\n1, 41, 7\n", "steps of 7 do not lead from node 1 to node 41");
  expect_refused(ends + "*NFILL, BIAS=2\nleft, right, 4, 10\n", "*nfill with bias is not read");
  expect_refused(ends + "*NFILL\nleft, top, 4, 10\n", "there is no set of nodes \"top\"");
  expect_refused(ends + "*NCOPY, OLD SET=left, REFLECT=MIRROR\n", "*ncopy is read with SHIFT alone");
  expect_refused(ends + "*ELGEN\n1, 4\n", "there is no element 1");
}

TEST(Decks, ReadTheFilesThatTheyInclude) {
  const std::string deck = "*NODE, INPUT=\"my nodes.txt\"\n*INCLUDE, INPUT=elements.inp\n*AMPLITUDE, INPUT=none.txt\n";
  EXPECT_EQ(files_named_in("a.inp", deck), (std::vector<std::string>{"my nodes.txt", "elements.inp"}));
  const std::string elements = "*ELEMENT, TYPE=C3D8\n" + cube_element;
  const Deck whole(deck, {{"my nodes.txt", cube_nodes, "my nodes.txt"}, {"elements.inp", elements, "elements.inp"}});
  ASSERT_EQ(whole.elements(), 1U) << whole.said;
  expect_box(whole.box_of(0), {0, 0, 0}, {10, 10, 10});
  // Lines of an included file continue the data above.
  const Deck data("*NODE\n1, 0, 0, 0\n*INCLUDE, INPUT=rest.txt\n*ELEMENT, TYPE=C3D8\n" + cube_element,
                  {{"rest.txt", std::string_view(cube_nodes).substr(cube_nodes.find('\n') + 1), "rest.txt"}});
  EXPECT_EQ(data.elements(), 1U) << data.said;
  expect_refused(deck, "a.inp:1:1: error: the file \"my nodes.txt\", which the deck includes, cannot be read");
  const Deck circle("*INCLUDE, INPUT=b.inp\n", {{"b.inp", "*INCLUDE, INPUT=b.inp\n", "b.inp"}});
  EXPECT_NE(circle.said.find("b.inp:1:1: error: the file \"b.inp\" includes itself"), std::string::npos) << circle.said;
}

TEST(Decks, KeywordsThatChangeTheMeshAreRefused) {
  for (const char* keyword : {"*NMAP, TYPE=RECTANGULAR", "*IMPERFECTION, FILE=a", "*SYMMETRIC MODEL GENERATION",
                              "*ADJUST, SURFACE=a", "*REFINE MESH, LIMIT=5"})
    expect_refused(cube + keyword + "\n1, 2\n", "changes the mesh and is not read");
  const Deck removed(cube + "*STEP\n*MODEL CHANGE, REMOVE\nall\n*END STEP\n");
  EXPECT_EQ(removed.elements(), 1U);
  EXPECT_NE(removed.said.find("removes elements in a step"), std::string::npos) << removed.said;
  expect_cube(cube + "*TRANSFORM, NSET=all, TYPE=C\n0, 0, 0, 0, 0, 1\n");
}

const std::string plate = "*NODE\n1, 0, 0, 0\n2, 10, 0, 0\n3, 10, 10, 0\n4, 0, 10, 0\n";
const std::string plate_shell = "*ELEMENT, TYPE=S4R, ELSET=skin\n1, 1, 2, 3, 4\n";

// The shell is 10 mm by 10 mm large.
TEST(Decks, ShellsHaveTheThicknessOfTheirSection) {
  const auto box = [](const std::string& section) {
    const Deck deck(plate + plate_shell + section);
    EXPECT_EQ(deck.elements(), 1U) << deck.said;
    return deck.elements() == 1 ? deck.box_of(0) : Box();
  };
  expect_box(box("*SHELL SECTION, ELSET=skin, MATERIAL=a\n2., 5\n"), {0, 0, -1}, {10, 10, 1});
  expect_box(box("*Shell Section, elset=SKIN, material=a, OFFSET=SPOS\n2\n"), {0, 0, -2}, {10, 10, 0});
  expect_box(box("*SHELL SECTION, ELSET=skin, OFFSET=-0.5\n2\n"), {0, 0, 0}, {10, 10, 2});
  expect_box(box("*SHELL SECTION, ELSET=skin, COMPOSITE\n1, 3, a, 0\n0.5, 3, b, 90\n"), {0, 0, -0.75}, {10, 10, 0.75});
  expect_box(box("*SHELL GENERAL SECTION, ELSET=skin, MATERIAL=a\n2\n"), {0, 0, -1}, {10, 10, 1});
  const std::string section = "*SHELL SECTION, ELSET=skin\n";
  expect_refused(plate + plate_shell + section + "0\n", "expected the thickness of the shells, above 0");
  expect_refused(plate + plate_shell + "*SHELL SECTION, ELSET=skin, NODAL THICKNESS\n", "a thickness that varies");
  expect_refused(plate + plate_shell + section + "1\n*NORMAL\n1, 1, 0, 0, 1\n", "the normals of shells are not read");
  const Deck thin(cube + "*ELEMENT, TYPE=S4\n2, 1, 2, 3, 4\n");
  EXPECT_EQ(thin.elements(), 1U);
  EXPECT_NE(thin.said.find("1 shells without a thickness"), std::string::npos) << thin.said;
}

TEST(Decks, ShellsHaveTheValuesOfTheirNodes) {
  const Deck warm(plate + plate_shell + "*SHELL SECTION, ELSET=skin\n2\n", {},
                  ResultsFile{"t.csv", "node, t\n1, 10\n2, 20\n3, 30\n4, 40\n"});
  ASSERT_EQ(warm.elements(), 1U) << warm.said;
  const std::vector<double>& values = warm.results->fields.at(0).values;
  for (size_t n = 0; n < 8; ++n) EXPECT_EQ(values[warm.results->nodes[n]], 10.0 * static_cast<double>(n % 4 + 1));
}

TEST(Decks, ShellsOfEveryKindAreSolids) {
  const std::string section = "*SHELL SECTION, ELSET=all\n2\n";
  const Deck triangle(plate + "*ELEMENT, TYPE=S3, ELSET=all\n1, 1, 2, 3\n" + section);
  ASSERT_EQ(triangle.elements(), 1U) << triangle.said;
  EXPECT_EQ(triangle.results->kinds[0], ElementKind::wedge6);
  expect_box(triangle.box_of(0), {0, 0, -1}, {10, 10, 1});
  const Deck curved(plate + "5, 5, 0, 0\n6, 10, 5, 0\n7, 5, 10, 0\n8, 0, 5, 0\n*ELEMENT, TYPE=S8R, ELSET=all\n" +
                    "1, 1, 2, 3, 4, 5, 6, 7, 8\n" + section);
  ASSERT_EQ(curved.elements(), 1U) << curved.said;
  ASSERT_EQ(curved.results->kinds[0], ElementKind::brick20);
  expect_box(curved.box_of(0), {0, 0, -1}, {10, 10, 1});
  const Vec3 twelfth = curved.results->points[curved.results->nodes[11]];  // between the first and fourth corner below
  EXPECT_NEAR(length(twelfth - Vec3{0, 5, -1}), 0, 1e-12);
  const Vec3 seventeenth = curved.results->points[curved.results->nodes[16]];  // between the first and fifth corner
  EXPECT_NEAR(length(seventeenth - Vec3{0, 0, 0}), 0, 1e-12);
}

// Shells at a right angle keep their normals; those of a tube of 36 plates share radial ones.
TEST(Decks, ShellsThatMeetNearlyFlatShareTheirNormals) {
  const Deck corner(plate + "5, 10, 0, 10\n6, 10, 10, 10\n" + plate_shell +
                    "2, 2, 5, 6, 3\n*SHELL SECTION, ELSET=skin\n2\n");
  ASSERT_EQ(corner.elements(), 2U) << corner.said;
  expect_box(corner.box_of(0), {0, 0, -1}, {10, 10, 1});
  expect_box(corner.box_of(1), {9, 0, 0}, {11, 10, 10});

  constexpr int count = 36;
  std::string nodes = "*NODE, SYSTEM=C\n", shells = "*ELEMENT, TYPE=S4, ELSET=tube\n";
  for (int n = 0; n < count; ++n) {
    for (const int level : {0, 1})
      nodes += std::to_string(2 * n + level + 1) + ", 20, " + std::to_string(10 * n) + ", " +
               std::to_string(30 * level) + "\n";
    const int a = 2 * n + 1, b = 2 * ((n + 1) % count) + 1;
    shells += std::to_string(n + 1) + ", " + std::to_string(a) + ", " + std::to_string(b) + ", " +
              std::to_string(b + 1) + ", " + std::to_string(a + 1) + "\n";
  }
  const Deck tube(nodes + shells + "*SHELL SECTION, ELSET=tube\n3\n");
  ASSERT_EQ(tube.elements(), 36U) << tube.said;
  for (const uint32_t node : tube.results->nodes) {
    const Vec3 p = tube.results->points[node];
    const double radius = std::hypot(p.x, p.y);
    EXPECT_NEAR(std::abs(radius - 20), 1.5, 1e-9);
  }
}

std::string sets_of(const Deck& deck) {
  std::string text;
  for (const ResultSet& set : deck.results->sets)
    text += set.name + ' ' + std::to_string(static_cast<int>(set.of)) + ' ' + std::to_string(set.count) + ", ";
  return text;
}

// Names are compared in lower case, and shown as they are written first.
TEST(Decks, SetsAndSurfacesAreCounted) {
  const std::string sets =
      replaced(replaced(cube, "*NODE", "*NODE, NSET=Nall"), "TYPE=C3D8", "TYPE=C3D8, ELSET=Body") +
      "*NSET, NSET=Base\n1, 2, 3, 4, 4\n*NSET, NSET=ends, GENERATE\n5, 8\n*NSET, NSET=ends\nBASE\n"
      "*SURFACE, NAME=Top, TYPE=ELEMENT\nbody, S2\n1, S3\n*SURFACE, NAME=points, TYPE=NODE\nbase\n";
  const std::string counted = "Base 0 4, ends 0 8, Nall 0 8, Body 1 1, points 2 4, Top 2 2, ";
  const Deck deck(sets);
  ASSERT_TRUE(deck.results) << deck.said;
  EXPECT_EQ(sets_of(deck), counted);
  // Two instances have the sets of their part each, and the assembly has sets of their nodes.
  const Deck twice("*PART, NAME=p\n" + sets +
                   "*END PART\n*ASSEMBLY, NAME=all\n*INSTANCE, NAME=a, PART=p\n*END INSTANCE\n"
                   "*INSTANCE, NAME=b, PART=p\n20.\n*END INSTANCE\n*NSET, NSET=held, INSTANCE=a\n1, 2\n"
                   "*NSET, NSET=held, INSTANCE=b\n1, 2, 3\n*ELSET, ELSET=_side, INSTANCE=b\n1\n"
                   "*SURFACE, NAME=Side\n_side, S1\n*END ASSEMBLY\n");
  ASSERT_TRUE(twice.results) << twice.said;
  EXPECT_EQ(sets_of(twice),
            "Base 0 8, ends 0 16, held 0 5, Nall 0 16, _side 1 1, Body 1 2, points 2 8, Side 2 1, Top 2 4, ");
}

}  // namespace ombre::formats
