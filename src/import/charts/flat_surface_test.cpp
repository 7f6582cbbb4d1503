// Compares surfaces that are laid out in a plane with geometry.
#include "import/charts/flat_surface.h"

#include <gtest/gtest.h>

#include <numbers>

#include "import/charts/test_patches.h"

namespace ombre::importing {
namespace {

class FlatSurfaces : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_flattening()) GTEST_SKIP() << "this build has no CGAL";
  }
  // The method that keeps lengths stops its iterations early.
  static double room_of(Flattening method) { return method == Flattening::arap ? 1e-3 : 1e-5; }
  static Vec2 lay_out(SurfacePatch& patch, Flattening method, Vec3 toward) {
    patch.places = flatten(patch.points, patch.triangles, method);
    EXPECT_FALSE(turned_over(patch));
    return align_places(patch, toward);
  }
};

}  // namespace

TEST_F(FlatSurfaces, PlanesStayAsTheyAre) {
  for (const Flattening method : {Flattening::lscm, Flattening::arap}) {
    SurfacePatch patch = grid_patch(9, 6, [](double a, double b) { return Vec3{30 * a, 10 * b, 2}; });
    const double room = room_of(method);
    const Vec2 lengths = lay_out(patch, method, {1, 0, 0});
    EXPECT_NEAR(lengths.x, 30, room);
    EXPECT_NEAR(lengths.y, 10, room);
    for (size_t n = 0; n < patch.points.size(); ++n) {
      EXPECT_NEAR(patch.places[n].x, patch.points[n].x, room);
      EXPECT_NEAR(patch.places[n].y, patch.points[n].y, room);
    }
  }
}

// A sector of 40 chords is developable, so angles and lengths can be kept exactly.
TEST_F(FlatSurfaces, CylindersAreUnrolledToTheirLength) {
  constexpr double radius = 10, angle = 2.5, chords = 40;
  const double developed = chords * 2 * radius * std::sin(angle / chords / 2);
  for (const Flattening method : {Flattening::lscm, Flattening::arap}) {
    SurfacePatch patch = cylinder_patch(radius, angle, 15, static_cast<uint32_t>(chords), 10);
    patch.places.clear();
    const Vec2 lengths = lay_out(patch, method, {0, 0, 1});
    EXPECT_NEAR(lengths.x, 15, room_of(method));
    EXPECT_NEAR(lengths.y, developed, room_of(method));
    const auto report = report_of(shell_above(patch, {0, 1e-6}));
    EXPECT_NEAR(report.stretches.lo, 1, room_of(method));
    EXPECT_NEAR(report.stretches.hi, 1, room_of(method));
  }
}

// A quarter of the belt of a sphere: angles are kept as far as triangles allow it, lengths are not (Gauss).
TEST_F(FlatSurfaces, PartsOfSpheresKeepTheirAngles) {
  SurfacePatch patch = sphere_patch(10, -0.6, 0.6, 40, 30);
  lay_out(patch, Flattening::lscm, {0, 0, 1});
  const auto report = report_of(shell_above(patch, {0, 1e-6}));
  EXPECT_LT(report.aspect, 1.04);
  EXPECT_GT(report.stretches.hi / report.stretches.lo, 1.05);
}

// A cap becomes a circle of the same area, as in Lambert's azimuthal projection.
TEST_F(FlatSurfaces, CapsBecomeCirclesOfTheirArea) {
  constexpr uint32_t rings = 16, spokes = 48;
  constexpr double radius = 10, steepest = 80 * std::numbers::pi / 180;
  SurfacePatch patch;
  patch.points.push_back({0, 0, radius});
  for (uint32_t ring = 1; ring <= rings; ++ring)
    for (uint32_t spoke = 0; spoke < spokes; ++spoke) {
      const double polar = steepest * ring / rings, turn = 2 * std::numbers::pi * spoke / spokes;
      patch.points.push_back(radius *
                             Vec3{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)});
    }
  const auto number = [&](uint32_t ring, uint32_t spoke) { return 1 + (ring - 1) * spokes + spoke % spokes; };
  for (uint32_t spoke = 0; spoke < spokes; ++spoke) {
    patch.triangles.push_back({0, number(1, spoke), number(1, spoke + 1)});
    for (uint32_t ring = 1; ring < rings; ++ring) {
      patch.triangles.push_back({number(ring, spoke), number(ring + 1, spoke), number(ring + 1, spoke + 1)});
      patch.triangles.push_back({number(ring, spoke), number(ring + 1, spoke + 1), number(ring, spoke + 1)});
    }
  }
  make_normals(patch);
  const Vec2 lengths = lay_out(patch, Flattening::authalic, {1, 0, 0});
  const double diameter = 4 * radius * std::sin(steepest / 2);
  EXPECT_NEAR(lengths.x, diameter, 0.02 * diameter);
  EXPECT_NEAR(lengths.y, diameter, 0.02 * diameter);
}

}  // namespace ombre::importing
