// Tests offsets, arrays, warps and maps: their distances, and patterns laid along surfaces.
#include "jobs/test_job_solids.h"

namespace ombre::compile {
namespace {

struct Sample {
  Vec3 p;
  TestSolid::Answer answer;
};

std::vector<Sample> samples(const TestSolid& solid, const Box& box, int count) {
  RandomPoints points(box);
  std::vector<Sample> list;
  for (int n = 0; n < count; ++n) {
    const Vec3 p = points.next();
    list.push_back({p, solid.at(p)});
  }
  return list;
}

// Checks that |g| is at most the distance between two points of which one is inside, since the surface lies between
// them.
void expect_bounds_of_the_distance(const std::string& text) {
  SCOPED_TRACE(text);
  const TestSolid solid(text);
  EXPECT_FALSE(solid.node().metric().is_implicit());
  const auto list = samples(solid, solid.node().bounds(design::design_space()).expanded(2), 1500);
  size_t inside = 0;
  for (const Sample& a : list) {
    inside += a.answer.inside;
    EXPECT_EQ(a.answer.inside, a.answer.distance <= 0);
    for (const Sample& b : list)
      if (a.answer.inside != b.answer.inside) {
        ASSERT_LE(std::abs(a.answer.distance), length(a.p - b.p) * (1 + 1e-9)) << a.p.x << " " << a.p.y << " " << a.p.z;
      }
  }
  EXPECT_GT(inside, 20u);
}

bool is_inside(const TestSolid& solid, double x, double y, double z) { return solid.at({x, y, z}).inside; }

std::string messages_of(const std::string& text) {
  Diagnostics diagnostics;
  load_text(text, diagnostics);
  return to_text(diagnostics);
}

}  // namespace

TEST(Distances, AreNeverMoreThanTheWayToTheSurface) {
  for (const char* text : {
           "offset(1.5) rectprism(4, 5, 3, \"red\");",
           "offset(-0.5) difference() { cube(6, \"red\"); sphere(2.5); }",
           "shell(1) cone(5, 2, 8, \"red\");",
           "shell(1, \"outward\") union() { cube(4, \"red\"); translate(3, 0, 0) sphere(2, \"red\"); }",
           "array_grid((4, 3, 2), (3, 4, 5)) ellipsoid((1, 1.5, 2), \"red\");",
           "array_linear(30, (1.1, 0.4, 0)) scale(1, 2, 1) sphere(0.8, \"red\");",
           "array_polar(14, radius=6) rectprism(3, 1, 2, \"red\");",
           "twist(20) rectprism(6, 2, 10, \"red\");",
           "twist(-12) translate(3, 0, 0) cylinder(1, 12, \"red\");",
           "taper(0.3, -4, 4) cube(8, \"red\");",
           "taper(2.5, 3, -2) cylinder(2, 8, \"red\");",
           "bend(8) rectprism(20, 3, 2, \"red\");",
           "bend(-9) rectprism(18, 3, 4, \"red\");",
           "remap(radius=9) rectprism(20, 6, 2, \"red\");",
           "remap(\"sphere\", 12) rectprism(22, 14, 3, \"red\");",
       })
    expect_bounds_of_the_distance(text);
}

// Each point is compared with the one that the node's formula gives, computed here again.
TEST(Warps, AskAtTheirPoints) {
  const std::string child = "translate(2, 1, 0.5) rectprism(6, 3, 4, \"red\");";
  const TestSolid plain(child), twist("twist(15) " + child), taper("taper(0.5, -2, 3) " + child),
      bend("bend(7) " + child), cylinder("remap(radius=5) " + child), sphere("remap(\"sphere\", 5) " + child);
  RandomPoints points(Box::centered({9, 9, 9}));
  for (int n = 0; n < 5000; ++n) {
    const auto [x, y, z] = points.next();
    const double turn = -15 * z * std::numbers::pi / 180, c = std::cos(turn), s = std::sin(turn);
    EXPECT_EQ(is_inside(twist, x, y, z), is_inside(plain, c * x - s * y, s * x + c * y, z));
    const double scale = z <= -2 ? 1 : z >= 3 ? 0.5 : 1 - 0.1 * (z + 2);
    EXPECT_EQ(is_inside(taper, x, y, z), is_inside(plain, x / scale, y / scale, z));
    EXPECT_EQ(is_inside(bend, x, y, z), is_inside(plain, 7 * std::atan2(x, 7 - z), y, 7 - std::hypot(x, z - 7)));
    const double rho = std::hypot(x, y), around = 5 * std::atan2(y, x);
    EXPECT_EQ(is_inside(cylinder, x, y, z), is_inside(plain, around, z, rho - 5));
    EXPECT_EQ(is_inside(sphere, x, y, z), is_inside(plain, around, 5 * std::atan2(z, rho), std::hypot(rho, z) - 5));
  }
}

TEST(Warps, SayWhatTheyCutOff) {
  EXPECT_EQ(messages_of("bend(10) rectprism(60, 2, 2, \"red\");"), "");
  EXPECT_NE(messages_of("bend(10) rectprism(64, 2, 2, \"red\");")
                .find("bend cuts off what reaches further than half a turn, "
                      "31.42 mm along x"),
            std::string::npos);
  EXPECT_NE(messages_of("bend(10) cube(24, \"red\");").find("what lies beyond the centre, 10 mm along z"),
            std::string::npos);
  EXPECT_NE(messages_of("bend(-10) cube(24, \"red\");").find("10 mm along -z"), std::string::npos);
  EXPECT_NE(messages_of("remap(radius=2) cube(5, \"red\");").find("2 mm along -z"), std::string::npos);
  EXPECT_NE(messages_of("remap(\"sphere\", 10) rectprism(5, 33, 1, \"red\");").find("beyond the poles"),
            std::string::npos);
}

TEST(Warps, FindTheirBounds) {
  const auto expect_near = [](const std::string& text, Vec3 lo, Vec3 hi, double tolerance) {
    const Box box = TestSolid(text).node().bounds(design::design_space());
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(box.lo[axis], lo[axis] + 1e-6) << text;
      EXPECT_GE(box.lo[axis], lo[axis] - tolerance) << text;
      EXPECT_GE(box.hi[axis], hi[axis] - 1e-6) << text;
      EXPECT_LE(box.hi[axis], hi[axis] + tolerance) << text;
    }
  };
  const double r = std::hypot(3, 2);
  expect_near("twist(20) rectprism(6, 4, 40, \"red\");", {-r, -r, -20}, {r, r, 20}, 1e-6);
  expect_near("taper(2, 0, 5) cube(10, \"red\");", {-10, -10, -5}, {10, 10, 5}, 1e-6);
  // Half a turn to each side closes the ring.
  const double pi = std::numbers::pi;
  expect_near("bend(10) rectprism(" + std::to_string(20 * pi - 1e-3) + ", 2, 2, \"red\");", {-11, -1, -1}, {11, 1, 21},
              1e-3);
  expect_near("remap(radius=10) rectprism(5, 6, 2, \"red\");", {9 * std::cos(0.25), -11 * std::sin(0.25), -3},
              {11, 11 * std::sin(0.25), 3}, 1e-6);
  // These bounds are found by bisection, so they are coarser.
  expect_near("warp(\"x - 2*sin(z)\", \"y\", \"z\") cylinder(3, 20, \"red\");", {-5, -3, -10}, {5, 3, 10}, 3);
}

TEST(ConformalMap, UnrollsACylinder) {
  const std::string pattern =
      "array_grid((6, 3, 1), (8, 5, 5), centred=true) rotate(20, 30, 40) rectprism(5, 2, 3, \"red\");";
  const TestSolid mapped("conformal_map(\"cylindrical\") { cylinder(9, 60); " + pattern + " }");
  const TestSolid unrolled("remap(radius=9) " + pattern);
  size_t inside = 0;
  for (const Sample& sample : samples(unrolled, Box::centered({13, 13, 10}), 20'000)) {
    if (std::abs(sample.answer.distance) < 1e-3) continue;  // normals come from differences
    inside += sample.answer.inside;
    EXPECT_EQ(mapped.at(sample.p).inside, sample.answer.inside);
    if (!sample.answer.inside) continue;
    EXPECT_NEAR(mapped.at(sample.p).distance, sample.answer.distance, 1e-4);
  }
  EXPECT_GT(inside, 500u);
}

TEST(ConformalMap, MovesAPatternOntoAPlane) {
  const std::string pattern = "rotate(20, 30, 40) rectprism(5, 2, 3, \"red\");";
  const TestSolid mapped("conformal_map() { translate(0, 0, -10) cube(40); " + pattern + " }");
  const TestSolid moved("translate(0, 0, 10) " + pattern);
  for (const Sample& sample : samples(moved, {{-5, -5, 5}, {5, 5, 15}}, 5000))
    EXPECT_NEAR(mapped.at(sample.p).distance, sample.answer.distance, 1e-9);
  // The plane has any angle, and the reference direction is its normal.
  const TestSolid tilted("conformal_map(ref_dir=(0, 1, 1)) { half_space((0, 1, 1)); " + pattern + " }");
  const TestSolid turned("rotate(axis=x, deg=-45) " + pattern);
  for (const Sample& sample : samples(turned, Box::centered({5, 5, 5}), 5000))
    EXPECT_NEAR(tilted.at(sample.p).distance, sample.answer.distance, 1e-9);
}

// On a cone, columns of the pattern stand at right angles to the slope: a rod of the pattern along z is a strut along
// the normal.
TEST(ConformalMap, FollowsNormals) {
  const TestSolid mapped("conformal_map(\"cylindrical\") { cone(20, 10, 20); cylinder(0.5, 8, \"red\"); }");
  // The slope has the normal (2, 1) / sqrt(5) in (rho, z), and radius 15 at z = 0.
  const double nx = 2 / std::sqrt(5.0), nz = 1 / std::sqrt(5.0);
  for (const double height : {-3.0, -1.5, 0.0, 1.5, 3.0}) {
    EXPECT_TRUE(is_inside(mapped, 15 + height * nx, 0, height * nz));
    EXPECT_TRUE(is_inside(mapped, 15 + height * nx - 0.4 * nz, 0, height * nz + 0.4 * nx));
    EXPECT_FALSE(is_inside(mapped, 15 + height * nx - 0.6 * nz, 0, height * nz + 0.6 * nx));
  }
}

}  // namespace ombre::compile
