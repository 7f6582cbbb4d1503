// Compares solids that turn into others with solids of known shape.
#include <cmath>
#include <random>

#include "nodes/test_solids.h"

namespace ombre::nodes {
namespace {

design::NodePtr ball(double radius, const char* material, const std::string& by = "[0, 0, 0]") {
  return Solid::node("translate", "{\"by\": " + by + "}",
                     {Solid::node("sphere", "{\"radius\": " + std::to_string(radius) + ", \"material\": \"" +
                                                std::string(material) + "\"}")});
}

design::NodePtr cells(const std::string& name, double radius, const char* material) {
  return Solid::node("tile", "{}",
                     {Solid::node("lattice", "{\"cell\": \"" + name + "\", \"size\": [4, 4, 4], \"radius\": " +
                                                 std::to_string(radius) + ", \"material\": \"" + material + "\"}")});
}

// Turns the first solid into the second one between x = 0 and x = length.
design::NodePtr ramp(int length, const std::string& mode, std::vector<design::NodePtr> solids) {
  const std::string weight = "min(max(x/" + std::to_string(length) + ", 0), 1)";
  return Solid::node("morph", "{\"weight\": \"" + weight + "\", \"mode\": \"" + mode + "\"}", std::move(solids));
}

template <class Check>
void at_random_points(Vec3 lo, Vec3 hi, const Check& check) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  for (int n = 0; n < 2000; ++n) {
    const double x = share(random), y = share(random), z = share(random);
    check(lo + Vec3{x * (hi.x - lo.x), y * (hi.y - lo.y), z * (hi.z - lo.z)});
  }
}

TEST(Morph, OfBallsAroundAPointIsABallOfTheMeanRadius) {
  double before = 2;
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Solid whole(
        Solid::node("morph", "{\"weight\": " + std::to_string(t) + "}", {ball(2, "red"), ball(5, "blue")}));
    EXPECT_NEAR(whole.distance({3, 4, 0}), 5 - (2 + 3 * t), 1e-12);
    EXPECT_EQ(whole.inside({1, 0, 0}), true);
    EXPECT_NEAR(whole.red({1, 0, 0}), 1 - t, 1e-12);
    // It grows with the weight.
    EXPECT_TRUE(whole.inside({before - 1e-6, 0, 0}));
    before = 2 + 3 * t;
    EXPECT_TRUE(whole.inside({0, before - 1e-6, 0}));
    EXPECT_FALSE(whole.inside({0, before + 1e-6, 0}));
  }
}

// Struts along the same axis have the mean radius, which a mixture of the lattices at their joints has, too.
TEST(Morph, OfStrutsIsAStrutOfTheMeanRadius) {
  const auto strut = [](const char* radius) {
    return Solid::node(
        "lattice",
        std::string(R"({"edges": [[[-20, 0, 0], [20, 0, 0]]], "material": "red", "radius": )") + radius + "}");
  };
  const Solid whole(ramp(10, "blend", {strut("1"), strut("3")}));
  for (double x = -12; x < 16; x += 1.7) {
    const double radius = 1 + 2 * std::clamp(x / 10, 0.0, 1.0);
    EXPECT_TRUE(whole.inside({x, radius - 1e-9, 0})) << x;
    EXPECT_FALSE(whole.inside({x, 0, radius + 1e-9})) << x;
  }
}

// Where one child has all the weight, nothing of it changes, in any mode.
TEST(Morph, IsTheChildThatHasAllTheWeight) {
  const Solid bcc(cells("bcc", 0.5, "red")), cubic(cells("cubic", 0.7, "blue"));
  for (const char* mode : {"blend", "sharp", "overlap"}) {
    const Solid whole(ramp(8, mode, {cells("bcc", 0.5, "red"), cells("cubic", 0.7, "blue")}));
    at_random_points({-10, -5, -5}, {0, 5, 5}, [&](Vec3 p) {
      EXPECT_EQ(whole.inside(p), bcc.inside(p));
      EXPECT_EQ(whole.distance(p), bcc.distance(p));
      if (bcc.inside(p)) {
        EXPECT_EQ(whole.red(p), 1);
      }
    });
    at_random_points({8, -5, -5}, {18, 5, 5}, [&](Vec3 p) {
      EXPECT_EQ(whole.inside(p), cubic.inside(p));
      EXPECT_EQ(whole.distance(p), cubic.distance(p));
      if (cubic.inside(p)) {
        EXPECT_EQ(whole.red(p), 0);
      }
    });
  }
}

TEST(Morph, MixesDistancesChoosesOrOverlaps) {
  const Solid bcc(cells("bcc", 0.5, "red")), cubic(cells("cubic", 0.7, "blue"));
  const auto made = [](const char* mode) {
    return Solid(ramp(8, mode, {cells("bcc", 0.5, "red"), cells("cubic", 0.7, "blue")}));
  };
  const Solid blend = made("blend"), sharp = made("sharp"), overlap = made("overlap");
  at_random_points({0.01, -5, -5}, {7.99, 5, 5}, [&](Vec3 p) {
    const double t = p.x / 8, mean = (1 - t) * bcc.distance(p) + t * cubic.distance(p);
    EXPECT_NEAR(blend.distance(p), mean, 1e-12);
    if (std::abs(mean) > 1e-9) {
      EXPECT_EQ(blend.inside(p), mean < 0);
    }
    EXPECT_EQ(sharp.inside(p), t < 0.5 ? bcc.inside(p) : cubic.inside(p));
    EXPECT_EQ(overlap.inside(p), bcc.inside(p) || cubic.inside(p));
    if (bcc.inside(p) && cubic.inside(p)) {
      EXPECT_NEAR(overlap.red(p), 1 - t, 1e-12);
    }
    if (bcc.inside(p) && !cubic.inside(p)) {
      EXPECT_EQ(overlap.red(p), 1);
    }
  });
}

// At distances 1 and 3 from the seeds, weights fall with the square: 9/10 and 1/10.
TEST(Morph, OfSeedsHasTheWeightsOfShepard) {
  const Solid whole(Solid::node("morph", R"({"seeds": [[0, 0, 0], [4, 0, 0]]})", {ball(6, "red"), ball(8, "blue")}));
  EXPECT_NEAR(whole.distance({1, 0, 0}), 0.9 * (1 - 6) + 0.1 * (1 - 8), 1e-12);
  EXPECT_NEAR(whole.red({1, 0, 0}), 0.9, 1e-12);
  EXPECT_NEAR(whole.red({0, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(whole.red({4, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(whole.red({2, 3, 1}), 0.5, 1e-12);
  const Solid cut(
      Solid::node("morph", R"({"seeds": [[0, 0, 0], [4, 0, 0]], "mode": "sharp"})", {ball(6, "red"), ball(8, "blue")}));
  EXPECT_EQ(cut.red({1.9, 3, 0}), 1);
  EXPECT_EQ(cut.red({2.1, 3, 0}), 0);
}

TEST(Morph, OfSeveralDividesByTheSumOfWeights) {
  const Solid whole(
      Solid::node("morph", R"({"weight": [2, "1 + x", 1]})", {ball(2, "red"), ball(6, "blue"), ball(10, "red")}));
  // The mean radius at x = 0 is (2*2 + 6 + 10)/4 = 5.
  EXPECT_NEAR(whole.distance({0, 7, 0}), 2, 1e-12);
  const Solid none(Solid::node("morph", R"({"weight": ["x", "0"]})", {ball(2, "red"), ball(6, "blue")}));
  EXPECT_FALSE(none.inside({-1, 0, 0}));
  EXPECT_TRUE(none.inside({1, 0, 0}));
  EXPECT_FALSE(none.inside({3, 0, 0}));
}

TEST(Morph, HasTheBoundsOfWhatCounts) {
  const auto small = ball(2, "red"), far = ball(3, "blue", "[20, 0, 0]");
  const Box both = Solid::node("morph", R"({"weight": "x/20"})", {small, far})->bounds(design::design_space());
  EXPECT_EQ(hull(both, Box{{-2, -2, -2}, {2, 2, 2}}), both);
  EXPECT_LE(both.hi.x, 23 + 1e-9);
  const Box one = Solid::node("morph", R"({"weight": 0})", {small, far})->bounds(design::design_space());
  EXPECT_LE(one.hi.x, 2 + 1e-9);
  // A half of each ball is nothing: no point is nearer to them than the mean of their distances.
  const Solid half(Solid::node("morph", R"({"weight": 0.5})", {small, far}));
  at_random_points({-3, -4, -4}, {24, 4, 4}, [&](Vec3 p) { EXPECT_FALSE(half.inside(p)); });
}

}  // namespace
}  // namespace ombre::nodes
