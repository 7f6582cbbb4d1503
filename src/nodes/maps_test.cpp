// Tests maps from one surface to another for which the result is known.
#include <cmath>
#include <random>

#include "nodes/test_solids.h"

namespace ombre::nodes {
namespace {

// Returns a tilted block that extends through the first surface.
design::NodePtr block(const std::string& at) {
  return Solid::node("translate", "{\"by\": " + at + "}",
                     {Solid::node("rotate", R"({"angles": [20, 10, 30]})",
                                  {Solid::node("rectprism", R"({"size": [3, 4, 2], "material": "red"})")})});
}

Solid mapped(const design::NodePtr& from, const design::NodePtr& to, const design::NodePtr& child) {
  return Solid(Solid::node("surface_map", R"({"height": 3})", {from, to, child}));
}

// Compares the child and its image at points near `at`.
template <class Move>
void expect_moved(const Solid& result, const Solid& child, Vec3 at, const Move& back) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-3, 3);
  int inside = 0;
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = at + Vec3{step(random), step(random), step(random)}, q = back(p);
    if (std::abs(child.distance(q)) < 1e-3) continue;
    EXPECT_EQ(result.inside(p), child.inside(q)) << p.x << " " << p.y << " " << p.z;
    inside += child.inside(q) ? 1 : 0;
  }
  EXPECT_GT(inside, 20);
}

TEST(SurfaceMap, OfASurfaceOntoItselfChangesNothing) {
  const auto ball = [] { return Solid::node("sphere", R"({"radius": 9})"); };
  const Solid child(block("[9, 0, 0]"));
  const Solid result = mapped(ball(), ball(), block("[9, 0, 0]"));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> step(-2.5, 2.5);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = Vec3{9, 0, 0} + Vec3{step(random), step(random), step(random)};
    if (std::abs(length(p) - 9) > 2.99) continue;
    EXPECT_NEAR(result.distance(p), std::max(child.distance(p), std::abs(length(p) - 9) - 3), 1e-4);
  }
}

TEST(SurfaceMap, BetweenPlanesMovesAlongTheNormal) {
  const Solid result = mapped(Solid::node("half_space", R"({"normal": [0, 0, 1]})"),
                              Solid::node("half_space", R"({"normal": [0, 0, 1], "offset": 7})"), block("[0, 0, 0.5]"));
  expect_moved(result, Solid(block("[0, 0, 0.5]")), {0, 0, 7.5}, [](Vec3 p) { return p - Vec3{0, 0, 7}; });
}

TEST(SurfaceMap, BetweenBallsMovesAlongRays) {
  const Solid result =
      mapped(Solid::node("sphere", R"({"radius": 8})"), Solid::node("sphere", R"({"radius": 11})"), block("[0, 8, 0]"));
  expect_moved(result, Solid(block("[0, 8, 0]")), {0, 11, 0}, [](Vec3 p) { return ((length(p) - 3) / length(p)) * p; });
}

TEST(SurfaceMap, BetweenCylindersMovesAwayFromTheAxis) {
  const Solid result = mapped(Solid::node("cylinder", R"({"radius": 12, "height": 60})"),
                              Solid::node("cylinder", R"({"radius": 9, "height": 60})"), block("[12, 0, 0]"));
  expect_moved(result, Solid(block("[12, 0, 0]")), {9, 0, 0}, [](Vec3 p) {
    const double rho = std::hypot(p.x, p.y);
    return Vec3{p.x * (rho + 3) / rho, p.y * (rho + 3) / rho, p.z};
  });
}

}  // namespace
}  // namespace ombre::nodes
