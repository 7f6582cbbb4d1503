// Compares random points in solids with what the distance between them promises.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "base/math/point_sets.h"
#include "nodes/common/lattice_noise.h"
#include "nodes/common/poisson_discs.h"

namespace ombre::nodes {
namespace {

double random_number(uint64_t n, int which) { return unit_of(cell_bits(static_cast<int64_t>(n), 0, 0, 7), which); }

Vec3 random_place(const Box& box, uint64_t n) {
  const Vec3 size = box.size();
  return box.lo + Vec3{size.x * random_number(n, 0), size.y * random_number(n, 1), size.z * random_number(n, 2)};
}

double nearest(const std::vector<Vec3>& points, Vec3 p, size_t except = ~size_t{0}) {
  double least = Box::inf;
  for (size_t n = 0; n < points.size(); ++n)
    if (n != except) least = std::min(least, length(points[n] - p));
  return least;
}

// A ball whose points are `apart(p)` mm from each other, which changes by at most a quarter of a mm for each mm.
template <class Apart>
PointHost ball(double radius, const Apart& apart) {
  return {
      Box::centered({radius, radius, radius}),
      [=](Vec3 p, std::vector<double>&) {
        return std::array{length(p) - radius, apart(p)};
      },
      [=](const Box& box) {
        const double reach = 0.5 * length(box.size()), outside = length(box.center()) - radius;
        const double wanted = apart(box.center());
        return std::array{Interval(outside - reach, outside + reach), Interval(wanted - reach / 4, wanted + reach / 4)};
      }};
}
PointHost plain_ball(double radius, double apart) {
  return ball(radius, [=](Vec3) { return apart; });
}

}  // namespace

TEST(ScatteredPoints, KeepTheirDistanceAndLeaveNoGaps) {
  constexpr double apart = 1.5, clearance = 0.4, radius = 8;
  const PointHost host = plain_ball(radius, apart);
  const ScatteredPoints found = scatter_points(host, {3, 0, clearance});
  ASSERT_EQ(found.problem, "");
  for (size_t n = 0; n < found.points.size(); ++n) {
    EXPECT_GE(nearest(found.points, found.points[n], n), apart);
    EXPECT_LE(length(found.points[n]), radius - clearance);
  }
  double farthest = 0;
  for (uint64_t n = 0; n < 20000; ++n) {
    const Vec3 p = random_place(host.box, n);
    if (length(p) <= radius - clearance) farthest = std::max(farthest, nearest(found.points, p));
  }
  EXPECT_LE(farthest, 1.2 * apart);
}

TEST(ScatteredPoints, DependOnTheSeedAlone) {
  const PointHost host = plain_ball(6, 1);
  const std::vector<Vec3> first = scatter_points(host, {5, 1}).points, again = scatter_points(host, {5, 1}).points;
  EXPECT_EQ(first, again);
  EXPECT_NE(first, scatter_points(host, {6, 1}).points);
}

// Balls around the points, half a distance wider than the host, fill the share of space of random sequential addition.
TEST(ScatteredPoints, AreAsDenseAsRandomSequentialAddition) {
  constexpr double radius = 12, apart = 1;
  const double count = static_cast<double>(scatter_points(plain_ball(radius, apart), {}).points.size());
  const double inner = points_per_cubed_distance * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
  EXPECT_GT(count, 0.97 * inner);
  EXPECT_LT(count, 1.03 * points_per_cubed_distance * 4 / 3 * std::numbers::pi * std::pow(radius + apart / 2, 3));
}

TEST(ScatteredPoints, FollowADistanceThatVaries) {
  const auto apart = [](Vec3 p) { return 1.5 + p.x / 8; };
  const PointHost host = ball(6, apart);
  const std::vector<Vec3> points = scatter_points(host, {1}).points;
  for (size_t n = 0; n < points.size(); ++n) EXPECT_GE(nearest(points, points[n], n), apart(points[n]));
  for (uint64_t n = 0; n < 20000; ++n) {
    const Vec3 p = random_place(host.box, n);
    if (length(p) > 6) continue;
    EXPECT_LE(nearest(points, p), 1.5 * apart(p)) << p.x;
  }
}

// Lloyd's steps bring points to the centres of their cells, and keep the distances.
TEST(ScatteredPoints, RelaxTowardsTheCentresOfTheirCells) {
  const PointHost host = plain_ball(6, 1.5);
  const auto off_center = [&](const std::vector<Vec3>& points) {
    std::vector<Vec3> sums(points.size());
    std::vector<double> counts(points.size());
    for (uint64_t n = 0; n < 40000; ++n) {
      const Vec3 p = random_place(host.box, n);
      if (length(p) > 6) continue;
      size_t own = 0;
      for (size_t i = 1; i < points.size(); ++i)
        if (length(points[i] - p) < length(points[own] - p)) own = i;
      sums[own] = sums[own] + p;
      counts[own] += 1;
    }
    double total = 0;
    for (size_t i = 0; i < points.size(); ++i) total += length((1 / counts[i]) * sums[i] - points[i]);
    return total / static_cast<double>(points.size());
  };
  const std::vector<Vec3> raw = scatter_points(host, {2, 0}).points, relaxed = scatter_points(host, {2, 20}).points;
  ASSERT_EQ(raw.size(), relaxed.size());
  EXPECT_LT(off_center(relaxed), 0.65 * off_center(raw));
  for (size_t n = 0; n < relaxed.size(); ++n) EXPECT_GE(nearest(relaxed, relaxed[n], n), 1.5);
}

// Four cells of points in general position meet in each corner of a Voronoi cell, so four edges end there.
TEST(ScatteredPoints, FourEdgesOfVoronoiCellsMeetInEachCorner) {
  if (!knows_point_sets()) GTEST_SKIP() << "this build has no Qhull";
  const std::vector<Vec3> points = scatter_points(plain_ball(6, 1.2), {4}).points;
  const auto edges = voronoi_edges(points, std::nullopt);
  ASSERT_EQ(edges.problem, "");
  const auto rounded = [](double v) { return std::round(v * 1e7) / 1e7; };
  std::map<std::array<double, 3>, int> ends;
  for (const Edge3& edge : edges.list)
    for (const Vec3& end : edge) ++ends[{rounded(end.x), rounded(end.y), rounded(end.z)}];
  int inner = 0;
  for (const auto& [at, count] : ends) {
    if (length(Vec3{at[0], at[1], at[2]}) > 4) continue;
    EXPECT_EQ(count, 4);
    ++inner;
  }
  EXPECT_GT(inner, 500);
}

TEST(ScatteredPoints, TooManyAreAProblem) {
  PointRules rules;
  rules.most = 100;
  EXPECT_EQ(scatter_points(plain_ball(10, 1), rules).problem, "more than 100 points would fit");
  const auto negative = ball(4, [](Vec3 p) { return 0.5 + p.x / 4; });
  EXPECT_NE(scatter_points(negative, {}).problem.find("must be positive"), std::string::npos);
}

}  // namespace ombre::nodes
