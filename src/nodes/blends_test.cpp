// Compares fillets and chamfers with their geometry.
#include <cmath>
#include <numbers>
#include <random>

#include "nodes/test_solids.h"

namespace ombre::nodes {
namespace {

design::NodePtr wall(int axis) {
  const char* normals[] = {"[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"};
  return Solid::node("half_space", "{\"normal\": " + std::string(normals[axis]) + ", \"material\": \"" +
                                       (axis == 0 ? "red" : "blue") + "\"}");
}

std::vector<Vec3> random_centres(size_t count) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> at(-800, 800);
  std::vector<Vec3> centres(count);
  for (Vec3& c : centres)
    for (int axis = 0; axis < 3; ++axis) c[axis] = at(random) / 100.0;
  return centres;
}

// Returns balls of radius 1.5, alternately blue and red.
design::NodePtr balls(size_t count, const std::string& kind, const std::string& parameters) {
  std::vector<design::NodePtr> parts;
  for (const Vec3 c : random_centres(count)) {
    const std::string material = parts.size() % 2 ? "red" : "blue";
    const auto ball = Solid::node("sphere", "{\"radius\": 1.5, \"material\": \"" + material + "\"}");
    const std::string by = std::to_string(c.x) + ", " + std::to_string(c.y) + ", " + std::to_string(c.z);
    parts.push_back(Solid::node("translate", "{\"by\": [" + by + "]}", {ball}));
  }
  return Solid::node(kind, parameters, parts);
}

TEST(Blend, OfWallsAtARightAngleIsACircle) {
  const double k = 2;
  const Solid joint(Solid::node("union", R"({"blend": 2})", {wall(0), wall(1)}));
  // The fillet in the empty corner is a quarter circle around (k, k).
  for (double angle = 185; angle < 268; angle += 7) {
    const double c = std::cos(angle * M_PI / 180), s = std::sin(angle * M_PI / 180);
    EXPECT_NEAR(joint.distance({k + k * c, k + k * s, 0}), 0, 1e-12);
    EXPECT_TRUE(joint.inside({k + (k + 1e-6) * c, k + (k + 1e-6) * s, 5}));
    EXPECT_FALSE(joint.inside({k + (k - 1e-6) * c, k + (k - 1e-6) * s, 5}));
    EXPECT_NEAR(joint.distance({k + 0.5 * k * c, k + 0.5 * k * s, 0}), 0.5 * k, 1e-12);  // exact in the fillet
  }
  EXPECT_NEAR(joint.distance({3, 5, 0}), 3, 1e-12);  // the nearer wall, beyond the reach of the fillet
}

TEST(Blend, OfTheirComplementsRoundsTheEdge) {
  const Solid rounded(Solid::node("intersection", R"({"blend": 2})", {wall(0), wall(1)}));
  EXPECT_NEAR(rounded.distance({-2 + 2 * std::sqrt(0.5), -2 + 2 * std::sqrt(0.5), 0}), 0, 1e-12);
  EXPECT_FALSE(rounded.inside({-0.1, -0.1, 0}));
  EXPECT_TRUE(rounded.inside({-0.6, -0.6, 0}));
  const Solid cut(Solid::node("difference", R"({"blend": 2})", {wall(0), Solid::node("negate", "{}", {wall(1)})}));
  for (const Vec3 p : {Vec3{-0.5, -0.4, 1}, Vec3{-3, -1, 2}, Vec3{1, -2, 0}, Vec3{-0.2, -0.3, 0}})
    EXPECT_NEAR(cut.distance(p), rounded.distance(p), 1e-12);
}

TEST(Blend, ChamfersBeginTheirSizeAway) {
  const Solid joint(Solid::node("union", R"({"blend": 2, "join": "chamfer"})", {wall(0), wall(1)}));
  for (double x = 0.1; x < 2; x += 0.3) EXPECT_NEAR(joint.distance({x, 2 - x, 0}), 0, 1e-12);
  EXPECT_TRUE(joint.inside({0.9, 0.9, 0}));
  EXPECT_FALSE(joint.inside({1.1, 1.1, 0}));
}

TEST(Blend, OfRadiusZeroIsSharp) {
  const Solid sharp(balls(5, "union", "{}")), zero(balls(5, "union", R"({"blend": 0})")),
      tiny(balls(5, "union", R"({"blend": 1e-9})"));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-10, 10);
  for (int n = 0; n < 200; ++n) {
    const Vec3 p{at(random), at(random), at(random)};
    EXPECT_EQ(sharp.distance(p), zero.distance(p));
    if (sharp.distance(p) > 0) {
      EXPECT_NEAR(sharp.distance(p), tiny.distance(p), 1e-8);
    }
  }
}

// Tests solids in tables as well as solids written out.
TEST(Blend, IsTheFormulaForAnyNumberOfSolids) {
  for (const size_t count : {3, 60}) {
    const Solid joint(balls(count, "union", R"({"blend": 1.25, "materials": "blend"})"));
    const std::vector<Vec3> centres = random_centres(count);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> at(-8, 8);
    for (int n = 0; n < 300; ++n) {
      const Vec3 p{at(random), at(random), at(random)};
      double total = 0, red = 0, least = 1e9;
      for (size_t i = 0; i < count; ++i) {
        const double d = length(p - centres[i]) - 1.5, w = std::max(1.25 - d, 0.0);
        total += w * w;
        if (i % 2) red += w * w;
        least = std::min(least, d);
      }
      const double g = std::max(1.25, least) - std::sqrt(total);
      EXPECT_NEAR(joint.distance(p), g, 1e-9);
      if (std::abs(g) < 1e-9) continue;
      EXPECT_EQ(joint.inside(p), g <= 0);
      if (g <= 0) {
        EXPECT_NEAR(joint.red(p), red / total, 1e-9);
      }
    }
  }
}

// Points within a solid have its material. In the fillet, outside all solids, materials are mixed by weights.
TEST(Blend, MixesMaterialsInTheFillet) {
  const Solid joint(Solid::node("union", R"({"blend": 2})", {wall(0), wall(1)}));
  EXPECT_NEAR(joint.red({0.3, 0.3, 0}), 0.5, 1e-12);
  EXPECT_NEAR(joint.red({0.1, 0.9, 0}), 1.9 * 1.9 / (1.9 * 1.9 + 1.1 * 1.1), 1e-12);
  EXPECT_EQ(joint.red({-1, 0.5, 0}), 1);
  EXPECT_EQ(joint.red({-1, -0.5, 0}), 0.5);
  const Solid first(Solid::node("union", R"({"blend": 2, "materials": "first"})", {wall(0), wall(1)}));
  EXPECT_EQ(first.red({-1, -0.5, 0}), 1);
}

// The points whose distances to two balls add up to at most 6 form an ellipsoid with foci at x = 3 and -3 and half axes
// 4 and sqrt(7).
TEST(Sum, WithoutBlendIsALevelSetThatHasBounds) {
  const auto ball = [](const char* by) {
    return Solid::node("translate", std::string("{\"by\": ") + by + "}", {Solid::node("sphere", R"({"radius": 1})")});
  };
  const design::NodePtr node = Solid::node("sum", R"({"iso": 6})", {ball("[3, 0, 0]"), ball("[-3, 0, 0]")});
  const Box ellipsoid = Box::centered({4, std::sqrt(7.0), std::sqrt(7.0)}),
            bounds = node->bounds(design::design_space());
  EXPECT_EQ(hull(bounds, ellipsoid), bounds);
  EXPECT_LE(bounds.hi.x, 7 + 1e-9);
  const Solid sum(node);
  EXPECT_NEAR(sum.share(ellipsoid, 40), std::numbers::pi / 6, 0.003);
  EXPECT_FALSE(sum.inside({4.001, 0, 0}));
  EXPECT_TRUE(sum.inside({0, 2.645, 0}));
  // The sum of distances is never that low.
  const Solid none(Solid::node("sum", R"({"iso": -3})", {ball("[3, 0, 0]"), ball("[-3, 0, 0]")}));
  EXPECT_FALSE(none.inside({3, 0, 0}));
}

TEST(Blend, SumsOfManyChildrenAreThoseOfTheFormula) {
  const Solid sum(balls(50, "sum", R"({"blend": 1})"));
  const std::vector<Vec3> centres = random_centres(50);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-8, 8);
  int held = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p{at(random), at(random), at(random)};
    double total = 0;
    for (const Vec3 c : centres) {
      const double t = std::clamp((1 - (length(p - c) - 1.5)) / 2, 0.0, 1.0);
      total += t * t * (3 - 2 * t);
    }
    if (std::abs(total - 0.5) < 1e-9) continue;
    EXPECT_EQ(sum.inside(p), total >= 0.5);
    held += total >= 0.5 ? 1 : 0;
  }
  EXPECT_GT(held, 30);
}

}  // namespace
}  // namespace ombre::nodes
