#include "formats/mesh/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ombre::formats {
namespace {

using Polygon = std::vector<Vec3>;

Vec3 area_vector(const Polygon& polygon, const Corners& t) {
  return 0.5 * cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]);
}

// Checks that the triangles' areas add up to the polygon's, and that none is turned over.
void expect_no_folds(const Polygon& polygon, double area) {
  PolygonCutter cutter;
  const auto triangles = cutter.cut(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  double sum = 0;
  for (const Corners& t : triangles) sum += length(area_vector(polygon, t));
  EXPECT_NEAR(sum, area, 1e-9 * area);
}

// Returns a star about the origin in the plane to which `map` maps z = 0.
Polygon star(size_t corners, double inner, const Affine& map) {
  Polygon polygon;
  for (size_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    const double r = i % 2 == 0 ? 1 : inner;
    polygon.push_back(map({r * std::cos(angle), r * std::sin(angle), 0}));
  }
  return polygon;
}

TEST(PolygonCutter, ConvexPolygonsBecomeFans) {
  PolygonCutter cutter;
  EXPECT_EQ(cutter.cut(star(5, 1, {})), (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(PolygonCutter, ConcavePolygonsDoNotFold) {
  const Polygon arrow{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
  expect_no_folds(arrow, 16 - 6);
  const Polygon notch_first{{2, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}};
  expect_no_folds(notch_first, 16 - 6);
  for (const size_t corners : {8u, 30u, 2000u}) {
    const double turn = 2 * std::numbers::pi / static_cast<double>(corners);
    const double area = 0.3 * std::sin(turn) / 2 * static_cast<double>(corners);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 2, 3}})
      expect_no_folds(star(corners, 0.3, Affine::rotation(axis, 90)), area);
    expect_no_folds(star(corners, 0.3, Affine::scaling({-1, 1, 1})), area);
  }
}

TEST(PolygonCutter, ASlitToAHoleIsAllowed) {
  const Polygon ring{{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0},
                     {2, 2, 0}, {2, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}};
  expect_no_folds(ring, 36 - 4);
}

TEST(PolygonCutter, PointsOnALineKeepTheArea) {
  const Polygon square{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  expect_no_folds(square, 4);
}

TEST(PolygonCutter, AnyPolygonKeepsItsEdges) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(0, 3);
  PolygonCutter cutter;
  for (int turn = 0; turn < 2000; ++turn) {
    Polygon polygon(4 + turn % 9);
    for (Vec3& p : polygon) p = {double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
    const auto n = polygon.size();
    // Directed edges count +1, their reverses -1: only the polygon's own edges remain.
    std::vector<int> uses(n * n, 0);
    for (const Corners& t : cutter.cut(polygon))
      for (size_t i = 0; i < 3; ++i) {
        ++uses[t[i] * n + t[(i + 1) % 3]];
        --uses[t[(i + 1) % 3] * n + t[i]];
      }
    for (size_t a = 0; a < n; ++a)
      for (size_t b = 0; b < n; ++b) {
        const int expected = b == (a + 1) % n ? 1 : a == (b + 1) % n ? -1 : 0;
        ASSERT_EQ(uses[a * n + b], expected);
      }
  }
}

}  // namespace
}  // namespace ombre::formats
