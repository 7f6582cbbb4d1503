#include "render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ombre::render {
namespace {

double degrees(double angle) { return angle * 3.14159265358979323846 / 180; }

double any(std::mt19937& random, double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); }

std::array<Vec3, 8> corners_of(const Box& box) {
  std::array<Vec3, 8> points;
  for (size_t n = 0; n < 8; ++n)
    points[n] = {(n & 1U) != 0 ? box.hi.x : box.lo.x, (n & 2U) != 0 ? box.hi.y : box.lo.y,
                 (n & 4U) != 0 ? box.hi.z : box.lo.z};
  return points;
}

}  // namespace

TEST(Camera, NamedViewsLookWhereTheirNamesSay) {
  struct View {
    const char* name;
    Vec3 forward, right;
  };
  for (const View& view : {View{"front", {0, 1, 0}, {1, 0, 0}}, View{"back", {0, -1, 0}, {-1, 0, 0}},
                           View{"left", {1, 0, 0}, {0, -1, 0}}, View{"right", {-1, 0, 0}, {0, 1, 0}},
                           View{"top", {0, 0, -1}, {1, 0, 0}}, View{"bottom", {0, 0, 1}, {1, 0, 0}}}) {
    const Camera camera = camera_around(Box::centered({1, 1, 1}), *named_view(view.name), 1);
    EXPECT_EQ(camera.forward, view.forward) << view.name;
    EXPECT_EQ(camera.right, view.right) << view.name;
    EXPECT_EQ(camera.down, cross(view.forward, view.right)) << view.name;
  }
}

TEST(Camera, EveryNameHasAView) {
  EXPECT_EQ(view_names().size(), 7U);
  for (const std::string& name : view_names()) EXPECT_TRUE(named_view(name)) << name;
  for (const char* name : {"", "Front", "front ", "side"}) EXPECT_FALSE(named_view(name)) << name;
}

// The eye stands at azimuth 0 in front, at -y, at 90 at +x.
TEST(Camera, EyeStandsWhereItsAnglesSay) {
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    ViewOptions options;
    options.azimuth_deg = any(random, -180, 180);
    options.elevation_deg = any(random, -90, 90);
    const Camera camera = camera_around(Box::centered({1, 2, 3}), options, 1.5);
    const double azimuth = degrees(options.azimuth_deg), elevation = degrees(options.elevation_deg);
    const Vec3 eye{std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation),
                   std::sin(elevation)};
    EXPECT_LT(length(camera.forward + eye), 1e-12);
    EXPECT_NEAR(camera.right.z, 0, 1e-12);
    EXPECT_LT(length(camera.down - cross(camera.forward, camera.right)), 1e-12);
    EXPECT_NEAR(length(camera.right), 1, 1e-12);
    EXPECT_LE(camera.down.z, 1e-12);
  }
}

TEST(Camera, ProjectionsLeadBack) {
  std::mt19937 random(4);
  for (const double field_of_view : {0.0, 5.0, 60.0, 120.0}) {
    ViewOptions options;
    options.field_of_view_deg = field_of_view;
    const Box box{{-3, 1, 2}, {5, 2, 9}};
    const Camera camera = camera_around(box, options, 1);
    EXPECT_EQ(camera.is_orthographic(), field_of_view == 0);
    EXPECT_LT(length(camera.in_view(box.center())), 1e-12);
    for (int round = 0; round < 100; ++round) {
      const Vec3 p{any(random, -3, 5), any(random, 1, 2), any(random, 2, 9)};
      EXPECT_LT(length(camera.design_from_view()(camera.unprojected(camera.in_view(p))) - p), 1e-10);
    }
  }
}

// In a pinhole's picture at a distance of 100 mm, lengths 100 mm behind it have half their size, and 50 mm before it
// twice their size.
TEST(Camera, LengthsShrinkWithTheDistanceFromTheEye) {
  Camera camera;
  camera.distance_mm = 100;
  EXPECT_EQ(camera.in_view({3, 100, 4}), (Vec3{100, 1.5, -2}));
  EXPECT_EQ(camera.in_view({3, -50, 4}), (Vec3{-50, 6, -8}));
  EXPECT_EQ(camera.in_view({3, 0, 4}), (Vec3{0, 3, -4}));
  EXPECT_EQ(camera.stretch_at(-100), 0);
  camera.distance_mm = 0;
  EXPECT_EQ(camera.in_view({3, 100, 4}), (Vec3{100, 3, -4}));
}

TEST(Camera, PicturesHoldTheBoxWithLittleRoom) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const Vec3 lo{any(random, -20, 20), any(random, -20, 20), any(random, -20, 20)};
    const Box box{lo, lo + Vec3{any(random, 0.1, 9), any(random, 0.1, 9), any(random, 0.1, 9)}};
    ViewOptions options;
    options.azimuth_deg = any(random, -180, 180);
    options.elevation_deg = any(random, -90, 90);
    if (round % 2 == 1) options.field_of_view_deg = any(random, 1, 150);
    const double aspect = any(random, 0.3, 3);
    const Camera camera = camera_around(box, options, aspect);
    double greatest = 0;  // share of the half height or half width
    for (const Vec3 corner : corners_of(box)) {
      const Vec3 p = camera.in_view(corner);
      if (!camera.is_orthographic()) {
        EXPECT_GT(p.x, -camera.distance_mm);
      }
      greatest =
          std::max({greatest, 2 * std::abs(p.z) / camera.height_mm, 2 * std::abs(p.y) / (aspect * camera.height_mm)});
    }
    EXPECT_LE(greatest, 1);
    EXPECT_GE(greatest, 0.9);
  }
}

// The ball around a box of 2 x 4 x 4 mm has a radius of 3 mm. A cone of 60 degrees touches it from 6 mm.
TEST(Camera, SeesTheBallAroundTheBoxFromItsDistance) {
  ViewOptions options;
  options.field_of_view_deg = 60;
  const Box box = Box::centered({1, 2, 2});
  EXPECT_NEAR(camera_around(box, options, 1).distance_mm, 6, 1e-12);
  options.target = Vec3{0, 0, 4};
  EXPECT_NEAR(camera_around(box, options, 1).distance_mm, 14, 1e-12);
  EXPECT_EQ(camera_around(box, options, 1).target, (Vec3{0, 0, 4}));
  options.field_of_view_deg = 179.999;
  EXPECT_GT(camera_around(box, options, 1).distance_mm, 7);
}

TEST(Camera, ZoomsWithoutMoving) {
  for (const double field_of_view : {0.0, 40.0}) {
    ViewOptions options;
    options.field_of_view_deg = field_of_view;
    const Box box = Box::centered({1, 2, 3});
    const Camera whole = camera_around(box, options, 1);
    options.zoom = 4;
    const Camera near = camera_around(box, options, 1);
    EXPECT_EQ(near.height_mm, whole.height_mm / 4);
    EXPECT_EQ(near.distance_mm, whole.distance_mm);
    options.height_mm = 12;
    EXPECT_EQ(camera_around(box, options, 1).height_mm, 3);
  }
}

}  // namespace ombre::render
