// Compares distances to cells, segments and triangles between points with a search of all of them.
#include "import/fields/path_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "import/fields/segment_tree.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

class PointSources : public testing::Test {
 protected:
  Vec3 random_point(double half) {
    std::uniform_real_distribution<double> number(-half, half);
    return {number(random_), number(random_), number(random_)};
  }
  std::vector<Vec3> random_points(size_t count) {
    std::vector<Vec3> points(count);
    for (Vec3& p : points) p = random_point(10);
    return points;
  }
  void expect_ranges(const program::FieldSource& source) {
    for (int n = 0; n < 200; ++n) {
      const Vec3 low = random_point(12), size = random_point(4);
      const Box box{low, low + Vec3{std::abs(size.x), std::abs(size.y), std::abs(size.z)}};
      const Interval range = source.range(0, box);
      for (const double share : {0.0, 0.3, 1.0}) {
        const double value = source.sample(0, box.lo + share * box.size());
        EXPECT_GE(value, range.lo);
        EXPECT_LE(value, range.hi);
      }
    }
  }

  std::mt19937 random_{11};
};

}  // namespace

// In the plane of two segments at a right angle, their fillet is a quarter of a circle around the point that is
// radius + fillet away from both.
TEST_F(PointSources, FilletsOfSegmentsAtARightAngleAreCircles) {
  const double radius = 0.5, fillet = 0.75, reach = radius + fillet;
  const auto source = make_filleted_source({{0, 0, 0}, {9, 0, 0}, {0, 0, 0}, {0, 9, 0}}, reach);
  for (double angle = 182; angle < 269; angle += 8) {
    const Vec3 p{reach + fillet * std::cos(angle * M_PI / 180), reach + fillet * std::sin(angle * M_PI / 180), 0};
    EXPECT_NEAR(source->sample(0, p), radius, 1e-12);
  }
  // Beyond the fillet, distances are those of the nearest segment.
  EXPECT_EQ(source->sample(0, {5, 0.5, 0}), 0.5);
  EXPECT_EQ(source->sample(0, {5, 1, -1}), std::sqrt(2.0));
  EXPECT_EQ(source->sample(0, {1, 7, 3}), std::sqrt(10.0));
}

// Where two segments are equally near, at any angle, the surface is fillet / sqrt(2) deeper than the fillet's radius.
TEST_F(PointSources, FilletsHaveTheDepthOfTheirFormula) {
  const double radius = 0.5, fillet = 1, reach = radius + fillet;
  for (const double half : {0.3, 0.6, 1.2}) {
    const Vec3 one{9 * std::cos(half), 9 * std::sin(half), 0}, other{9 * std::cos(half), -9 * std::sin(half), 0};
    const auto source = make_filleted_source({{}, one, {}, other}, reach);
    const double off = radius + fillet * (1 - std::sqrt(0.5));
    EXPECT_NEAR(source->sample(0, {off / std::sin(half), 0, 0}), radius, 1e-12);
  }
}

TEST_F(PointSources, FilletsAreTheFormulaForManySegments) {
  const double reach = 2.5;
  const std::vector<Vec3> points = random_points(120);
  const auto source = make_filleted_source(points, reach);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random_point(13);
    double sum = 0, least = Box::inf;
    for (size_t i = 0; i < points.size(); i += 2) {
      const double d = std::sqrt(squared_distance(LineSegment{points[i], points[i + 1]}, p));
      sum += d < reach ? (reach - d) * (reach - d) : 0;
      least = std::min(least, d);
    }
    EXPECT_NEAR(source->sample(0, p), sum > 0 ? reach - std::sqrt(sum) : least, 1e-12);
  }
  expect_ranges(*source);
  expect_ranges(*make_filleted_source(points, 0.2));
}

// The walls of the nearest point's cell lie in the planes between it and the others.
TEST_F(PointSources, CellsEndHalfWayBetweenPoints) {
  const std::vector<Vec3> points = random_points(300);
  const auto source = make_point_cells_source(points);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random_point(12);
    size_t own = 0;
    for (size_t i = 1; i < points.size(); ++i)
      if (length(points[i] - p) < length(points[own] - p)) own = i;
    double least = Box::inf;
    for (size_t i = 0; i < points.size(); ++i) {
      if (i == own) continue;
      const Vec3 way = points[i] - points[own];
      least = std::min(least, dot(0.5 * (points[i] + points[own]) - p, way) / length(way));
    }
    EXPECT_NEAR(source->sample(0, p), least, 1e-12);
  }
  expect_ranges(*source);
}

TEST_F(PointSources, SegmentsAndTrianglesAreTheNearestOfAll) {
  const std::vector<Vec3> points = random_points(300);
  const auto segments = make_segments_source(points), triangles = make_triangles_source(points);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random_point(12);
    double to_segments = Box::inf, to_triangles = Box::inf;
    for (size_t i = 0; i < points.size(); i += 2)
      to_segments = std::min(to_segments, squared_distance_to_segment(p, points[i], points[i + 1]));
    for (size_t i = 0; i < points.size(); i += 3)
      to_triangles = std::min(to_triangles, squared_distance(p, {points[i], points[i + 1], points[i + 2]}));
    EXPECT_NEAR(segments->sample(0, p), std::sqrt(to_segments), 1e-12);
    EXPECT_NEAR(triangles->sample(0, p), std::sqrt(to_triangles), 1e-12);
  }
  expect_ranges(*segments);
  expect_ranges(*triangles);
}

}  // namespace ombre::importing
