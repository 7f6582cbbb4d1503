// Compares unit cells and tiles with published densities, explicit copies and geometry.
#include <cmath>
#include <random>

#include "nodes/lattices/unit_cells.h"
#include "nodes/test_solids.h"

namespace ombre::nodes {
namespace {

std::string cell(const std::string& name, double radius) {
  return "{\"cell\": \"" + name + "\", \"size\": [1, 1, 1], \"radius\": " + std::to_string(radius) + "}";
}

Solid tiled(const std::string& name, double radius) {
  return Solid(Solid::node("tile", "{}", {Solid::node("lattice", cell(name, radius))}));
}

// Returns the length of struts in a periodic cell of side one. Struts on a face count half, those on an edge a quarter.
double length_per_cell(const UnitCell& unit) {
  double sum = 0;
  for (const auto& [a, b] : unit.struts) {
    const Vec3 middle = 0.5 * (a + b);
    double share = 1;
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(middle[axis]) == 0.5 && a[axis] == b[axis]) share /= 2;
    sum += share * length(b - a);
  }
  return sum;
}

TEST(UnitCells, HaveThePublishedLengthOfStruts) {
  const std::map<std::string, double> expected{
      {"cubic", 3},
      {"bcc", 4 * std::sqrt(3)},
      {"bccz", 4 * std::sqrt(3) + 1},
      {"fcc", 6 * std::sqrt(2)},
      {"fccz", 6 * std::sqrt(2) + 1},
      {"f2bcc", 6 * std::sqrt(2) + 4 * std::sqrt(3)},
      {"octahedral", 6 * std::sqrt(2)},
      {"octet", 12 * std::sqrt(2)},  // Deshpande et al. 2001: density 6 sqrt(2) pi (r/l)^2 with l = 1/sqrt(2)
      {"kelvin", 6 * std::sqrt(2)},  // 24 edges per cell with length sqrt(2)/4
      {"rhombic_dodecahedron", 8 * std::sqrt(3)},  // 32 edges per cell with length sqrt(3)/4
      {"diamond", 4 * std::sqrt(3)},               // 16 bonds per cell with length sqrt(3)/4
  };
  for (const UnitCell& unit : unit_cells())
    EXPECT_NEAR(length_per_cell(unit), expected.at(std::string(unit.name)), 1e-12) << unit.name;
}

// The volume of thin struts is pi r^2 times their length, minus the overlap at joints, which is at most a few balls
// each.
TEST(UnitCells, HaveTheDensityOfTheirStruts) {
  constexpr double r = 0.04;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-0.5, 0.5);
  for (const UnitCell& unit : unit_cells()) {
    const Solid lattice = tiled(std::string(unit.name), r);
    constexpr int samples = 40000;
    int count = 0;
    for (int n = 0; n < samples; ++n) count += lattice.inside({at(random), at(random), at(random)}) ? 1 : 0;
    const double density = static_cast<double>(count) / samples, first_order = M_PI * r * r * length_per_cell(unit);
    const double error = 4 * std::sqrt(first_order * (1 - first_order) / samples);
    const double joints = 60 * r * r * r;
    EXPECT_LT(density, first_order + error) << unit.name;
    EXPECT_GT(density, first_order - joints - error) << unit.name;
  }
}

// The overlap of three sets of crossing cylinders is Steinmetz's solid.
TEST(UnitCells, CubicHasItsExactVolume) {
  constexpr double r = 0.15;
  const double exact = 3 * M_PI * r * r - 8 * std::sqrt(2) * r * r * r;
  EXPECT_NEAR(tiled("cubic", r).share(Box::centered({0.5, 0.5, 0.5}), 80), exact, 2e-3);
}

// Cells include the struts of neighbours at any thickness, whether copies overlap or are separate.
TEST(Tile, IsWhatExplicitCopiesAre) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-0.75, 0.75);
  for (const UnitCell& unit : unit_cells()) {
    const std::string name(unit.name);
    for (const auto& [radius, step] : {std::pair(0.05, 1.0), {0.2, 1.0}, {0.1, 0.75}, {0.1, 1.25}}) {
      std::vector<design::NodePtr> copies;
      const auto text = [step = step](int n) { return std::to_string(n * step); };
      for (int n = 0; n < 343; ++n) {
        const std::string by = text(n % 7 - 3) + ", " + text(n / 7 % 7 - 3) + ", " + text(n / 49 - 3);
        copies.push_back(
            Solid::node("translate", "{\"by\": [" + by + "]}", {Solid::node("lattice", cell(name, radius))}));
      }
      const std::string s = text(1);
      const Solid explicit_copies(Solid::node("union", "{}", copies));
      const Solid tile(Solid::node("tile", "{\"size\": [" + s + ", " + s + ", " + s + "]}",
                                   {Solid::node("lattice", cell(name, radius))}));
      for (int n = 0; n < 40; ++n) {
        const Vec3 p{at(random), at(random), at(random)};
        EXPECT_NEAR(tile.distance(p), explicit_copies.distance(p), 1e-12) << name << " " << step;
        EXPECT_EQ(tile.inside(p), explicit_copies.inside(p)) << name << " " << step;
      }
    }
  }
}

// Here copies overlap.
TEST(Tile, OfSimpleSolidsIsWhatExplicitCopiesAre) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> at(-3, 3);
  for (const auto& [type, parameters] :
       std::map<std::string, std::string>{{"sphere", R"({"radius": 1.2})"},
                                          {"cube", R"({"side": 1.7})"},
                                          {"rectprism", R"({"size": [0.5, 3, 1]})"},
                                          {"cylinder", R"({"radius": 0.9, "height": 2.5})"},
                                          {"ellipsoid", R"({"radii": [1.5, 0.5, 0.7]})"},
                                          {"cone", R"({"base": 1, "top": 0.2, "height": 2.2})"}}) {
    std::vector<design::NodePtr> copies;
    for (int n = 0; n < 1331; ++n) {
      const std::string by = std::to_string(2 * (n % 11 - 5)) + ", " + std::to_string(1.5 * (n / 11 % 11 - 5)) + ", " +
                             std::to_string(1.8 * (n / 121 - 5));
      copies.push_back(Solid::node("translate", "{\"by\": [" + by + "]}", {Solid::node(type, parameters)}));
    }
    const Solid explicit_copies(Solid::node("union", "{}", copies));
    const Solid tile(Solid::node("tile", R"({"size": [2, 1.5, 1.8]})", {Solid::node(type, parameters)}));
    for (int n = 0; n < 60; ++n) {
      const Vec3 p{at(random), at(random), at(random)};
      EXPECT_NEAR(tile.distance(p), explicit_copies.distance(p), 1e-12) << type;
      EXPECT_EQ(tile.inside(p), explicit_copies.inside(p)) << type;
    }
  }
}

// The child is off its cell's centre, has materials, and is repeated along two axes within limits.
TEST(Tile, AsksNeighboursThatReachIn) {
  const auto child = [] {
    return Solid::node("translate", R"({"by": [1.2, 0.7, 0.3]})",
                       {Solid::node("rotate", R"({"angles": [10, 20, 30]})",
                                    {Solid::node("rectprism", R"({"size": [3.1, 1, 1], "material": "red"})")})});
  };
  struct Limits {
    int first_x, last_x, first_y, last_y;
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-9, 12);
  // Some limits allow no more copies than a point has neighbours.
  for (const Limits& l : {Limits{-2, 3, -4, 4}, {0, 1, 0, 1}, {1, 2, -1, -1}, {0, 0, 2, 4}, {-3, -1, 0, 3}}) {
    std::vector<design::NodePtr> copies;
    for (int i = l.first_x; i <= l.last_x; ++i)
      for (int j = l.first_y; j <= l.last_y; ++j)
        copies.push_back(Solid::node(
            "translate", "{\"by\": [" + std::to_string(2 * i) + ", " + std::to_string(1.5 * j) + ", 0]}", {child()}));
    const Solid explicit_copies(Solid::node("union", "{}", copies));
    const auto pair = [](int x, int y) { return "[" + std::to_string(x) + ", " + std::to_string(y) + ", 0]"; };
    const Solid tile(Solid::node("tile",
                                 R"({"size": [2, 1.5, 0], "first": )" + pair(l.first_x, l.first_y) + R"(, "last": )" +
                                     pair(l.last_x, l.last_y) + "}",
                                 {child()}));
    for (int n = 0; n < 400; ++n) {
      const Vec3 p{at(random), at(random), 0.2 * at(random)};
      EXPECT_EQ(tile.inside(p), explicit_copies.inside(p)) << p.x << " " << p.y << " " << p.z;
      if (!tile.inside(p)) {
        EXPECT_NEAR(tile.distance(p), explicit_copies.distance(p), 1e-12);
      }
    }
  }
}

TEST(Tile, GivesTheCopysIndices) {
  const auto ball = Solid::node("sphere", R"({"radius": 0.4})");
  const auto graded = Solid::node(
      "fgrade",
      R"J({"functions": ["ci == 2 and cj == -1", "1 - (ci == 2 and cj == -1)"], "materials": ["red", "blue"]})J",
      {ball});
  const Solid tile(Solid::node("tile", R"({"size": [1, 1, 1]})", {graded}));
  EXPECT_EQ(tile.red({2.1, -0.9, 7}), 1);
  EXPECT_EQ(tile.red({1.1, -0.9, 7}), 0);
  // The size depends on the cell's index, limited by clamp.
  const Solid sized(Solid::node("tile", R"({"size": [1, 1, 0]})",
                                {Solid::node("sphere", R"J({"radius": "clamp(0.1, 0.1*ci, 0.4)"})J")}));
  EXPECT_NEAR(sized.distance({3, 0, 0}), -0.3, 1e-12);
  EXPECT_NEAR(sized.distance({2, 5, 0}), -0.2, 1e-12);
}

TEST(Lattice, KnowsThePlaceAlongAStrut) {
  const Solid graph(Solid::node(
      "lattice", R"({"edges": [[[0, 0, 0], [10, 0, 0]], [[0, 0, 0], [0, 4, 0], 0.5]], "radius": "0.2 + 0.3*t"})"));
  EXPECT_NEAR(graph.along({7, 0, 0.1}), 0.7, 1e-12);
  EXPECT_NEAR(graph.along({0, 3, 0.1}), 0.75, 1e-12);
  EXPECT_NEAR(graph.distance({10, 0, 0}), -0.5, 1e-12);
  EXPECT_NEAR(graph.distance({5, 0, 1}), 1 - 0.35, 1e-12);
  EXPECT_NEAR(graph.distance({0, 2, 0.1}), -0.4, 1e-12);
  const Solid strut(Solid::node("fgrade", R"({"functions": ["t", "1 - t"], "materials": ["red", "blue"]})",
                                {Solid::node("strut", R"({"start": [1, 0, 0], "end": [5, 0, 0], "radius": 1})")}));
  EXPECT_NEAR(strut.red({2, 0.3, 0}), 0.25, 1e-12);
}

// With this many edges, the struts are rows of a table.
TEST(Lattice, IsTheUnionOfItsStruts) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> at(-10, 10);
  std::string list;
  std::vector<std::pair<Vec3, Vec3>> edges;
  for (int n = 0; n < 100; ++n) {
    const Vec3 a{std::round(at(random)), std::round(at(random)), std::round(at(random))},
        b{a.x + 2, std::round(at(random)), a.z};
    edges.emplace_back(a, b);
    const auto text = [](Vec3 p) {
      return "[" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + "]";
    };
    list += (n ? ", [" : "[") + text(a) + ", " + text(b) + "]";
  }
  const Solid lattice(Solid::node("lattice", "{\"edges\": [" + list + "], \"radius\": 0.6}"));
  for (int n = 0; n < 500; ++n) {
    const Vec3 p{at(random), at(random), at(random)};
    double least = 1e9;
    for (const auto& [a, b] : edges) {
      const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
      least = std::min(least, length(p - a - t * (b - a)) - 0.6);
    }
    EXPECT_NEAR(lattice.distance(p), least, 1e-12);
    if (std::abs(least) > 1e-9) {
      EXPECT_EQ(lattice.inside(p), least <= 0);
    }
  }
}

}  // namespace
}  // namespace ombre::nodes
