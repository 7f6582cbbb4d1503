// Ways along surfaces whose shortest ones are known by unfolding them.
#include "import/charts/shortest_ways.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "base/text/error.h"
#include "import/charts/flat_surface.h"
#include "import/charts/test_patches.h"

namespace ombre::importing {
namespace {

class Ways : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_flattening()) GTEST_SKIP() << "this build has no CGAL";
  }
};

program::SourceField source_of(const SurfacePatch& patch, const std::vector<Vec3>& from) {
  return make_geodesic_source("patch", patch.points, patch.triangles, from, {});
}

SurfacePatch cube(double side) {
  SurfacePatch patch;
  for (int n = 0; n < 8; ++n) patch.points.push_back({side * (n & 1), side * ((n >> 1) & 1), side * ((n >> 2) & 1)});
  patch.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return patch;
}

// Returns an icosahedron of radius 1 whose triangles are divided into four, several times, and moved onto the ball.
SurfacePatch ball(int times) {
  const double g = (1 + std::sqrt(5)) / 2;
  SurfacePatch patch;
  for (const Vec3 p : {Vec3{-1, g, 0},
                       {1, g, 0},
                       {-1, -g, 0},
                       {1, -g, 0},
                       {0, -1, g},
                       {0, 1, g},
                       {0, -1, -g},
                       {0, 1, -g},
                       {g, 0, -1},
                       {g, 0, 1},
                       {-g, 0, -1},
                       {-g, 0, 1}})
    patch.points.push_back(p);
  patch.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int n = 0; n < times; ++n) {
    SurfacePatch next;
    next.points = patch.points;
    std::map<std::array<uint32_t, 2>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [found, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, next.points.size());
      if (is_new) next.points.push_back(0.5 * (patch.points[a] + patch.points[b]));
      return found->second;
    };
    for (const auto& [a, b, c] : patch.triangles) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Corners& t : {Corners{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) next.triangles.push_back(t);
    }
    patch = std::move(next);
  }
  for (Vec3& p : patch.points) p = (1 / length(p)) * p;
  return patch;
}

TEST_F(Ways, OnAPlaneAreStraight) {
  const SurfacePatch plane = grid_patch(7, 5, [](double a, double b) { return Vec3{14 * a, 10 * b, 3}; });
  const Vec3 begin{4.1, 2.7, 3};
  const auto source = source_of(plane, {begin + Vec3{0, 0, 5}});
  std::mt19937 random{7};
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 200; ++n) {
    const Vec3 p{14 * unit(random), 10 * unit(random), 3};
    EXPECT_NEAR(source->sample(0, p), length(p - begin), 1e-9);
    EXPECT_EQ(source->sample(0, p + Vec3{0, 0, -2}), source->sample(0, p)) << "the nearest point counts";
  }
  EXPECT_NEAR(source->sample(0, begin), 0, 1e-9);
}

// The unrolled cylinder is a rectangle as long as the chords; its shorter way around counts.
TEST_F(Ways, OnACylinderAreThoseOfTheRectangle) {
  constexpr uint32_t columns = 36;
  SurfacePatch pipe = cylinder_patch(10, 2 * std::numbers::pi, 20, columns, 4);
  for (Corners& t : pipe.triangles)  // the last column is the first one
    for (uint32_t& corner : t)
      if (corner % (columns + 1) == columns) corner -= columns;
  pipe.points.resize(5 * (columns + 1));
  const double chord = 20 * std::sin(std::numbers::pi / columns), whole = columns * chord;
  const auto at = [&](double around, double z) {  // a point at a length along the chords
    const double column = std::floor(around / chord), share = around / chord - column;
    const auto corner = [&](double n) {
      const double angle = 2 * std::numbers::pi * n / columns;
      return Vec3{10 * std::cos(angle), 10 * std::sin(angle), z};
    };
    return (1 - share) * corner(column) + share * corner(column + 1);
  };
  const auto source = source_of(pipe, {at(3.3, 4)});
  std::mt19937 random{8};
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 200; ++n) {
    const double around = whole * unit(random), z = 20 * unit(random);
    const double forth = std::abs(around - 3.3), shorter = std::min(forth, whole - forth);
    EXPECT_NEAR(source->sample(0, at(around, z)), std::hypot(shorter, z - 4), 1e-8);
  }
}

TEST_F(Ways, OnACubeAreThoseOfItsNets) {
  const auto from_corner = source_of(cube(2), {{0, 0, 0}});
  EXPECT_NEAR(from_corner->sample(0, {2, 2, 2}), 2 * std::sqrt(5), 1e-12);  // two squares in a row
  EXPECT_NEAR(from_corner->sample(0, {2, 2, 0}), std::sqrt(8), 1e-12);
  EXPECT_NEAR(from_corner->sample(0, {2, 1, 1}), std::hypot(3, 1), 1e-12);
  const auto from_face = source_of(cube(2), {{1, 1, 0}});
  EXPECT_NEAR(from_face->sample(0, {1, 1, 2}), 4, 1e-12);
  EXPECT_NEAR(from_face->sample(0, {0, 1, 1}), 2, 1e-12);
  EXPECT_NEAR(from_face->sample(0, {0.5, 1, 0}), 0.5, 1e-12);
  const auto from_both = source_of(cube(2), {{1, 1, 0}, {1, 1, 2}});
  EXPECT_NEAR(from_both->sample(0, {0, 1, 1.5}), 1.5, 1e-12);
}

// Ways on an inscribed polyhedron of edges h come within h^2/8 of those of the ball, by share.
TEST_F(Ways, OnABallAreNearGreatCircles) {
  const SurfacePatch sphere = ball(4);
  const double edge = 1.11 / 16;  // the longest edge, of the icosahedron's 1.05 that are stretched
  const auto source = source_of(sphere, {sphere.points[0]});
  for (size_t n = 0; n < sphere.points.size(); n += 37) {
    const double angle = std::acos(std::clamp(dot(sphere.points[n], sphere.points[0]), -1.0, 1.0));
    EXPECT_NEAR(source->sample(0, sphere.points[n]), angle, angle * edge * edge / 4 + 1e-12);
  }
}

TEST_F(Ways, NeedASheetInOnePiece) {
  SurfacePatch two = cube(1);
  const auto count = static_cast<uint32_t>(two.points.size());
  for (uint32_t n = 0; n < count; ++n) two.points.push_back(two.points[n] + Vec3{5, 0, 0});
  for (size_t n = 0; n < 12; ++n) {
    const Corners t = two.triangles[n];
    two.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  EXPECT_THROW(source_of(two, {{0, 0, 0}}), Error);
  EXPECT_NEAR(source_of(two, {{0, 0, 0}, {5, 0, 0}})->sample(0, {6, 1, 1}), std::sqrt(5), 1e-12);
  SurfacePatch fin = cube(1);
  fin.points.push_back({0.5, 0.5, 3});
  fin.triangles.push_back({0, 1, 8});
  EXPECT_THROW(source_of(fin, {{0, 0, 0}}), Error);
}

}  // namespace
}  // namespace ombre::importing
