#include "base/math/voronoi_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ombre {
namespace {

class VoronoiCells : public testing::Test {
 protected:
  void SetUp() override {
    if (!knows_point_sets()) GTEST_SKIP() << "built without Qhull";
  }
};

}  // namespace

// Points of a body-centred lattice have truncated octahedra as cells: 14 faces, 24 corners, 36 edges of sqrt(2)/4 of
// the lattice's side, half of its volume.
TEST_F(VoronoiCells, OfABodyCentredLatticeAreTruncatedOctahedra) {
  std::vector<Vec3> points;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
  constexpr double side = 4;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        for (const double off : {0.0, 0.5})
          points.push_back(
              {side * (i + off) + noise(random), side * (j + off) + noise(random), side * (k + off) + noise(random)});
  const OfPoints<VoronoiCell> cells = voronoi_cells(points);
  ASSERT_TRUE(cells.problem.empty()) << cells.problem;
  const Box inner{{3.9, 3.9, 3.9}, {10.1, 10.1, 10.1}};
  int tested = 0;
  for (size_t n = 0; n < points.size(); ++n) {
    if (!inner.contains(points[n])) continue;
    const VoronoiCell& cell = cells.list[n];
    ASSERT_TRUE(cell.is_bounded);
    EXPECT_EQ(cell.faces, 14U);
    EXPECT_EQ(cell.corners(), 24U);
    EXPECT_EQ(cell.edges, 36U);
    EXPECT_NEAR(cell.volume_mm3, side * side * side / 2, 1e-4);
    EXPECT_NEAR(cell.edges_mm, 36 * side * std::numbers::sqrt2 / 4, 1e-4);
    EXPECT_NEAR(cell.box.size().x, side, 1e-4);
    ++tested;
  }
  EXPECT_GE(tested, 8);
}

// Meijering 1953: cells of random points have 48 pi^2 / 35 + 2 faces on average, and 144 pi^2 / (24 pi^2 + 35) edges
// around a face. Volumes add up to that of space.
TEST_F(VoronoiCells, OfRandomPointsHaveTheirMeans) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0, 20);
  std::vector<Vec3> points;
  for (int n = 0; n < 8000; ++n) points.push_back({coordinate(random), coordinate(random), coordinate(random)});
  const OfPoints<VoronoiCell> cells = voronoi_cells(points);
  ASSERT_TRUE(cells.problem.empty()) << cells.problem;
  const Box inner{{4, 4, 4}, {16, 16, 16}};
  double count = 0, volume = 0, faces = 0, edges = 0;
  for (size_t n = 0; n < points.size(); ++n) {
    if (!inner.contains(points[n])) continue;
    ASSERT_TRUE(cells.list[n].is_bounded);
    ++count;
    volume += cells.list[n].volume_mm3;
    faces += static_cast<double>(cells.list[n].faces);
    edges += static_cast<double>(cells.list[n].edges);
  }
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(faces / count, 48 * pi * pi / 35 + 2, 0.25);
  EXPECT_NEAR(2 * edges / faces, 144 * pi * pi / (24 * pi * pi + 35), 0.03);
  EXPECT_NEAR(volume, 12 * 12 * 12, 0.03 * 12 * 12 * 12);
}

TEST_F(VoronoiCells, AtTheRimExtendToInfinity) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {-4, 1, 0}, {0, 4, 0}, {1, -4, 0}, {0, 0, 4}, {0, 1, -4}};
  const OfPoints<VoronoiCell> cells = voronoi_cells(points);
  ASSERT_TRUE(cells.problem.empty());
  EXPECT_TRUE(cells.list[0].is_bounded);
  for (size_t n = 1; n < points.size(); ++n) EXPECT_FALSE(cells.list[n].is_bounded) << n;
  EXPECT_FALSE(voronoi_cells(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}).problem.empty());
}

}  // namespace ombre
