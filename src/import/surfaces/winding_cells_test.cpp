#include "import/surfaces/winding_cells.h"

#include <gtest/gtest.h>

#include "import/surfaces/point_winding.h"
#include "import/surfaces/test_meshes.h"

namespace ombre::importing {
namespace {

using namespace test;

Mesh moved(Mesh mesh, Vec3 by) {
  for (Vec3& vertex : mesh.vertices) vertex = vertex + by;
  return mesh;
}

// Returns two copies of the mesh, one displaced.
Mesh twice(const Mesh& mesh, Vec3 by) {
  Mesh both = mesh;
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) both.vertices.push_back(vertex + by);
  for (const auto& [a, b, c] : mesh.triangles) both.triangles.push_back({a + first, b + first, c + first});
  return both;
}

struct Share {
  size_t known = 0, queried = 0;
  double value() const { return static_cast<double>(known) / static_cast<double>(queried); }
};

// Compares points of a lattice, of a random path and on the surface.
Share compare(const Mesh& mesh) {
  const SurfacePtr surface = surface_of(mesh);
  const PointWinding exact(surface);
  const WindingCells cells(exact);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-0.02, 1.02);
  const Box box = bounds(*surface);
  std::vector<Vec3> points = mesh.vertices;
  for (int n = 0; n < 200000; ++n) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = box.lo[axis] + part(random) * box.size()[axis];
    points.push_back(point);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 on = (1.0 / 3) * (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]);
    points.insert(points.end(), {on, on + Vec3{1e-9, 0, 0}, on - Vec3{0, 0, 1e-9}});
  }
  Share share;
  for (const Vec3& point : points) {
    const auto winding = cells.at(point);
    ++share.queried;
    if (!winding) continue;
    ++share.known;
    EXPECT_EQ(*winding, exact.at(point)) << point.x << ' ' << point.y << ' ' << point.z;
  }
  return share;
}

TEST(WindingCells, AgreeWithQueriesOfSinglePoints) {
  EXPECT_GT(compare(torus(7, 2, 60, 30)).value(), 0.7);
  EXPECT_GT(compare(cuboid({-1, -2, -3}, {1, 2, 3})).value(), 0.8);
  EXPECT_GT(compare(sphere(10, 5)).value(), 0.7);
}

TEST(WindingCells, CountHowOftenMeshesWind) {
  const Mesh two = twice(sphere(10, 4), {4, 1, 2});
  EXPECT_GT(compare(two).value(), 0.7);
  const SurfacePtr surface = surface_of(two);
  const PointWinding exact(surface);
  EXPECT_EQ(WindingCells(exact).at({3, 0, 1}), 2);
}

TEST(WindingCells, AreSafeFarFromTheOrigin) {
  EXPECT_GT(compare(moved(torus(7, 2, 60, 30), {1e6, -1e6, 3e5})).value(), 0.7);
  compare(moved(torus(7e-3, 2e-3, 60, 30), {1e8, 0, 0}));
}

TEST(WindingCells, NothingIsKnownOfNothing) {
  const PointWinding nothing(surface_of({})), flat(surface_of(cuboid({0, 0, 0}, {1, 1, 0})));
  EXPECT_FALSE(WindingCells(nothing).at({0, 0, 0}));
  EXPECT_FALSE(WindingCells(flat).at({0.5, 0.5, 0}));
}

// Without larger boxes, the long triangles would set a billion flags.
TEST(WindingCells, LongTrianglesGetLargerBoxes) {
  Mesh fan = closed_grid(2000, 3, [](uint32_t u, uint32_t v) {
    const double angle = 2 * std::numbers::pi * u / 2000;
    return v == 0 ? Vec3{0, 0, 0} : Vec3{10 * std::cos(angle), 10 * std::sin(angle), v == 1 ? 10.0 : 9.0};
  });
  compare(fan);
}

}  // namespace
}  // namespace ombre::importing
