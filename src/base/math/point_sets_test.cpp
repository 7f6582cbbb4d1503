#include "base/math/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace ombre {
namespace {

class PointSets : public testing::Test {
 protected:
  void SetUp() override {
    if (!knows_point_sets()) GTEST_SKIP() << "built without Qhull";
  }
};

std::vector<Vec3> random_points(unsigned seed, size_t count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-5, 5);
  std::vector<Vec3> points;
  for (size_t n = 0; n < count; ++n) points.push_back({coordinate(random), coordinate(random), coordinate(random)});
  return points;
}

std::vector<Vec3> grid(int side) {
  std::vector<Vec3> points;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k)
        points.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  return points;
}

struct Tetrahedron {
  std::array<size_t, 4> corners;
  Vec3 center;
};

// Solves |c - p0| = |c - pi| by Cramer's rule.
Vec3 circumcenter(Vec3 p0, Vec3 p1, Vec3 p2, Vec3 p3) {
  const Vec3 a = p1 - p0, b = p2 - p0, c = p3 - p0;
  const double volume = 2 * dot(a, cross(b, c));
  return p0 + (1 / volume) * (dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b));
}

// Returns all sets of four points whose circumsphere contains no other point, by definition.
std::vector<Tetrahedron> tetrahedra(const std::vector<Vec3>& points) {
  std::vector<Tetrahedron> found;
  for (size_t a = 0; a < points.size(); ++a)
    for (size_t b = a + 1; b < points.size(); ++b)
      for (size_t c = b + 1; c < points.size(); ++c)
        for (size_t d = c + 1; d < points.size(); ++d) {
          const Vec3 center = circumcenter(points[a], points[b], points[c], points[d]);
          const double radius = length(points[a] - center);
          const bool is_empty = std::none_of(points.begin(), points.end(),
                                             [&](Vec3 p) { return length(p - center) < radius * (1 - 1e-9); });
          if (is_empty) found.push_back({{a, b, c, d}, center});
        }
  return found;
}

std::set<std::set<size_t>> faces(const Tetrahedron& t) {
  std::set<std::set<size_t>> result;
  for (size_t without = 0; without < 4; ++without) {
    std::set<size_t> face(t.corners.begin(), t.corners.end());
    face.erase(t.corners[without]);
    result.insert(face);
  }
  return result;
}

bool are_close(const Edge3& a, const Edge3& b) {
  const auto ends = [](Vec3 p, Vec3 q) { return length(p - q) < 1e-6 * (1 + length(p)); };
  return (ends(a[0], b[0]) && ends(a[1], b[1])) || (ends(a[0], b[1]) && ends(a[1], b[0]));
}

}  // namespace

TEST_F(PointSets, HullOfACubeHasSixPlanes) {
  const auto planes = hull_planes(grid(3));
  ASSERT_TRUE(planes.problem.empty()) << planes.problem;
  ASSERT_EQ(planes.list.size(), 6u);
  for (const Plane& plane : planes.list) {
    EXPECT_NEAR(length(plane.normal), 1, 1e-12);
    EXPECT_NEAR(plane.offset, plane.normal.x + plane.normal.y + plane.normal.z > 0 ? 2 : 0, 1e-12);
  }
}

TEST_F(PointSets, HullHoldsAllPointsAndTouchesThem) {
  const auto points = random_points(4, 300);
  const auto planes = hull_planes(points);
  for (const Plane& plane : planes.list) {
    size_t touched = 0;
    for (const Vec3& p : points) {
      EXPECT_LE(dot(plane.normal, p), plane.offset);
      touched += dot(plane.normal, p) > plane.offset - 1e-9;
    }
    EXPECT_EQ(touched, 3u);
  }
}

TEST_F(PointSets, DelaunayEdgesHaveEmptySpheres) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto points = random_points(seed, 14);
    std::set<std::set<size_t>> expected;
    for (const Tetrahedron& t : tetrahedra(points))
      for (size_t i = 0; i < 4; ++i)
        for (size_t j = i + 1; j < 4; ++j) expected.insert({t.corners[i], t.corners[j]});
    const auto edges = delaunay_edges(points);
    std::set<std::set<size_t>> found;
    for (const auto& [a, b] : edges.list)
      found.insert({static_cast<size_t>(std::find(points.begin(), points.end(), a) - points.begin()),
                    static_cast<size_t>(std::find(points.begin(), points.end(), b) - points.begin())});
    EXPECT_EQ(found, expected);
    EXPECT_EQ(edges.list.size(), expected.size());
  }
}

TEST_F(PointSets, VoronoiEdgesJoinSpheresOfNeighbours) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto points = random_points(seed, 12);
    const auto cells = tetrahedra(points);
    std::vector<Edge3> expected;
    std::set<std::set<size_t>> triangles;
    for (size_t i = 0; i < cells.size(); ++i) {
      const auto mine = faces(cells[i]);
      triangles.insert(mine.begin(), mine.end());
      for (size_t j = i + 1; j < cells.size(); ++j) {
        const auto others = faces(cells[j]);
        const bool meet = std::any_of(mine.begin(), mine.end(), [&](const auto& f) { return others.contains(f); });
        if (meet) expected.push_back({cells[i].center, cells[j].center});
      }
    }
    const auto edges = voronoi_edges(points, std::nullopt);
    EXPECT_EQ(edges.list.size(), expected.size());
    for (const Edge3& edge : expected)
      EXPECT_TRUE(
          std::any_of(edges.list.begin(), edges.list.end(), [&](const Edge3& e) { return are_close(e, edge); }));
    // In a box that is large enough, each triangle has its edge.
    const auto all = voronoi_edges(points, Box::centered({1e6, 1e6, 1e6}));
    EXPECT_EQ(all.list.size(), triangles.size());
  }
}

// At every position of an edge, three points are equally near and none is nearer.
TEST_F(PointSets, VoronoiEdgesInABoxAreEquallyFar) {
  const auto points = random_points(77, 40);
  const Box box = Box::centered({6, 6, 6});
  const auto edges = voronoi_edges(points, box);
  EXPECT_GT(edges.list.size(), 100u);
  size_t at_sides = 0;
  for (const auto& [from, to] : edges.list) {
    EXPECT_TRUE(box.expanded(1e-9).contains(from) && box.expanded(1e-9).contains(to));
    for (const Vec3& end : {from, to})
      at_sides += std::max({std::abs(end.x), std::abs(end.y), std::abs(end.z)}) > 6 - 1e-9;
    const Vec3 middle = 0.5 * (from + to);
    std::vector<double> far;
    for (const Vec3& p : points) far.push_back(length(p - middle));
    std::sort(far.begin(), far.end());
    EXPECT_NEAR(far[2], far[0], 1e-6);
  }
  EXPECT_GT(at_sides, 20u);
}

// Eight points lie on each sphere, and Voronoi cells meet at the centres of the cubes.
TEST_F(PointSets, GridsHaveEdgesOfCubes) {
  const auto edges = voronoi_edges(grid(3), std::nullopt);
  ASSERT_EQ(edges.list.size(), 12u);
  for (const auto& [from, to] : edges.list) EXPECT_NEAR(length(to - from), 1, 1e-9);
  // Lines through the centres of cubes, from side to side: 4 along each axis, each in three pieces.
  const auto in_box = voronoi_edges(grid(3), Box{{-1, -1, -1}, {3, 3, 3}});
  EXPECT_EQ(in_box.list.size(), 36u);
  // The edges of the cubes are the shortest, and must exist in any triangulation.
  const auto delaunay = delaunay_edges(grid(3));
  const auto shortest = std::count_if(delaunay.list.begin(), delaunay.list.end(),
                                      [](const Edge3& e) { return std::abs(length(e[1] - e[0]) - 1) < 1e-12; });
  EXPECT_EQ(shortest, 54);
}

TEST_F(PointSets, SayWhatIsWrong) {
  const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.3, 0}};
  EXPECT_EQ(delaunay_edges(flat).problem, "all points lie in one plane");
  EXPECT_EQ(hull_planes(flat).problem, "all points lie in one plane");
  EXPECT_EQ(delaunay_edges(random_points(1, 4)).problem, "at least 5 points are needed, found 4");
  auto twins = random_points(1, 8);
  twins[6] = twins[2];
  EXPECT_EQ(voronoi_edges(twins, std::nullopt).problem, "points 3 and 7 are the same");
  EXPECT_TRUE(hull_planes(twins).problem.empty());
  EXPECT_EQ(delaunay_edges(std::vector<Vec3>(1'000'001)).problem, "at most 1,000,000 points, found 1,000,001");
  EXPECT_EQ(hull_planes(std::vector<Vec3>(100'001)).problem, "at most 100,000 points, found 100,001");
  EXPECT_EQ(hull_planes(std::vector<Vec3>(5, Vec3{1, 2, 3})).problem, "all points lie in one plane");
}

TEST_F(PointSets, ComeInTheSameOrder) {
  const auto points = random_points(5, 60);
  EXPECT_EQ(delaunay_edges(points).list, delaunay_edges(points).list);
  EXPECT_EQ(voronoi_edges(points, std::nullopt).list, voronoi_edges(points, std::nullopt).list);
}

}  // namespace ombre
