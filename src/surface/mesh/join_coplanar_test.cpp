// Tests of joining coplanar facets. By Euler's formula a closed surface of V vertices has 2 V - 4 triangles.
#include "surface/mesh/join_coplanar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "surface/mesh/bodies.h"
#include "surface/mesh/snap_to_planes.h"

namespace ombre::surface {
namespace {

// Builds a surface of rectangles and triangles; equal corners become one vertex.
class Maker {
 public:
  explicit Maker(Vec3 (*place)(Vec3)) : place_(place) {}

  // Adds a face of n x n squares, counter-clockwise as seen from `front`.
  void add_face(Vec3 at, Vec3 u, Vec3 v, int n, Label back, Label front) {
    const auto corner = [&](int i, int j) { return vertex(at + (1.0 * i / n) * u + (1.0 * j / n) * v); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        surface.facets.push_back({{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)}, back, front});
        surface.facets.push_back({{corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)}, back, front});
      }
  }

  // Adds the faces of a cube, optionally without those across x.
  void add_cube(Vec3 at, int n, Label inside, bool has_low_x = true, bool has_high_x = true) {
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    if (has_low_x) add_face(at, z, y, n, inside, 0);
    if (has_high_x) add_face(at + x, y, z, n, inside, 0);
    add_face(at, x, z, n, inside, 0);
    add_face(at + y, z, x, n, inside, 0);
    add_face(at, y, x, n, inside, 0);
    add_face(at + z, x, y, n, inside, 0);
  }

  RegionSurface surface;

 private:
  uint32_t vertex(Vec3 at) {
    const std::array<long, 3> key{std::lround(at.x * 1e6), std::lround(at.y * 1e6), std::lround(at.z * 1e6)};
    const auto [found, is_new] = numbers_.emplace(key, static_cast<uint32_t>(surface.vertices.size()));
    if (is_new) surface.vertices.push_back(place_(at));
    return found->second;
  }

  Vec3 (*place_)(Vec3);
  std::map<std::array<long, 3>, uint32_t> numbers_;
};

Vec3 as_is(Vec3 p) { return p; }
Vec3 turned(Vec3 p) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  const Vec3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return {q.x, c * q.y - s * q.z, s * q.y + c * q.z};
}
Vec3 on_a_ball(Vec3 p) {
  const Vec3 from_middle = p - Vec3{0.5, 0.5, 0.5};
  return (1 / length(from_middle)) * from_middle;
}

constexpr double most_mm = 1e-6;

}  // namespace

TEST(JoinCoplanar, OfACubeLeavesTwelveTriangles) {
  for (const auto place : {as_is, turned}) {
    Maker maker(place);
    maker.add_cube({0, 0, 0}, 7, 1);
    join_coplanar(maker.surface, most_mm, {});
    EXPECT_EQ(maker.surface.vertices.size(), 8u);
    EXPECT_EQ(maker.surface.facets.size(), 12u);
    EXPECT_NEAR(volume_mm3(body_of(maker.surface, 1)), 1, 1e-12);
  }
}

// Two cubes with a common face have 12 corners, 10 rectangles outside and one between them.
TEST(JoinCoplanar, KeepsBordersOfRegions) {
  Maker maker(turned);
  maker.add_cube({0, 0, 0}, 5, 1, true, false);
  maker.add_cube({1, 0, 0}, 5, 2, false, true);
  maker.add_face({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 5, 1, 2);
  join_coplanar(maker.surface, most_mm, {});
  EXPECT_EQ(maker.surface.vertices.size(), 12u);
  EXPECT_EQ(maker.surface.facets.size(), 22u);
  for (const Label region : {Label{1}, Label{2}}) {
    const Body body = body_of(maker.surface, region);
    EXPECT_EQ(body.triangles.size(), 12u);
    EXPECT_NEAR(volume_mm3(body), 1, 1e-12);
  }
}

// All coordinates stay unchanged.
TEST(JoinCoplanar, LeavesCurvedSurfacesAlone) {
  Maker maker(on_a_ball);
  maker.add_cube({0, 0, 0}, 8, 1);
  const RegionSurface before = maker.surface;
  join_coplanar(maker.surface, most_mm, {});
  EXPECT_EQ(maker.surface.facets.size(), before.facets.size());
  EXPECT_EQ(maker.surface.vertices, before.vertices);
}

// One vertex inside a face and one on an edge are slightly displaced.
TEST(SnapToPlanes, MovesWhatIsNearlyInAPlane) {
  Maker maker(turned);
  maker.add_cube({0, 0, 0}, 7, 1);
  const std::vector<Vec3> right = maker.surface.vertices;
  for (const Vec3 place : {Vec3{3.0 / 7, 3.0 / 7, 0}, Vec3{3.0 / 7, 0, 0}}) {
    const Vec3 is = turned(place);
    const auto vertex = std::ranges::min_element(maker.surface.vertices, {}, [&](Vec3 v) { return length(v - is); });
    *vertex = turned(place + Vec3{0, 2e-5, -3e-5});
  }
  snap_to_planes(maker.surface, most_mm, 1e-4, {});
  for (size_t n = 0; n < right.size(); ++n) EXPECT_NEAR(length(maker.surface.vertices[n] - right[n]), 0, 2.1e-5) << n;
  join_coplanar(maker.surface, most_mm, {});
  EXPECT_EQ(maker.surface.facets.size(), 12u);
  EXPECT_NEAR(volume_mm3(body_of(maker.surface, 1)), 1, 1e-9);
}

TEST(SnapToPlanes, LeavesCurvedSurfacesAlone) {
  Maker maker(on_a_ball);
  maker.add_cube({0, 0, 0}, 8, 1);
  const RegionSurface before = maker.surface;
  snap_to_planes(maker.surface, most_mm, 1e-4, {});
  EXPECT_EQ(maker.surface.vertices, before.vertices);
}

// Vertices lie along a parabola, each within the allowed distance of the line between its neighbours. Removing them one
// by one must not accumulate the errors.
TEST(JoinCoplanar, DoesNotDrift) {
  constexpr double allowed = 1e-3, bend = 0.1;
  Maker maker([](Vec3 p) { return Vec3{p.x, p.y + bend * p.x * p.x, p.z}; });
  maker.add_cube({0, 0, 0}, 64, 1);
  join_coplanar(maker.surface, allowed, {});
  EXPECT_LT(maker.surface.facets.size(), 12u * 64 * 64 / 4);
  // A chord between two vertices of a parabola is off by a quarter of the bend times the square of their distance.
  std::set<double> xs;
  for (const Vec3& v : maker.surface.vertices) xs.insert(v.x);
  double before = 0;
  for (const double x : xs) {
    EXPECT_LE(bend / 4 * (x - before) * (x - before), 2 * allowed);
    before = x;
  }
}

}  // namespace ombre::surface
