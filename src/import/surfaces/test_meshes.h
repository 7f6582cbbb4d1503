// Closed meshes for tests, all facing outward.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

#include "formats/mesh/mesh.h"
#include "formats/mesh/vertex_merger.h"
#include "import/surfaces/surface.h"

namespace ombre::importing::test {

using formats::Mesh;

inline SurfacePtr surface_of(const Mesh& mesh) {
  return std::make_shared<Surface>(Surface{mesh.vertices, mesh.triangles});
}

// Returns the mesh as triangles that share no corners, which are displaced by up to `most` along each axis.
inline Mesh apart(const Mesh& mesh, std::mt19937& random, double most) {
  std::uniform_real_distribution<double> shift(-most, most);
  Mesh soup;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<uint32_t>(soup.vertices.size());
    for (const uint32_t corner : triangle)
      soup.vertices.push_back(mesh.vertices[corner] + Vec3{shift(random), shift(random), shift(random)});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

inline void add_quad(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

inline Mesh cuboid(Vec3 lo, Vec3 hi) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z});
  add_quad(mesh, 0, 2, 3, 1);
  add_quad(mesh, 4, 5, 7, 6);
  add_quad(mesh, 0, 1, 5, 4);
  add_quad(mesh, 2, 6, 7, 3);
  add_quad(mesh, 0, 4, 6, 2);
  add_quad(mesh, 1, 3, 7, 5);
  return mesh;
}

// Returns a grid of quads that is periodic in both directions.
template <class Point>
Mesh closed_grid(uint32_t columns, uint32_t rows, const Point& point) {
  Mesh mesh;
  for (uint32_t v = 0; v < rows; ++v)
    for (uint32_t u = 0; u < columns; ++u) mesh.vertices.push_back(point(u, v));
  for (uint32_t v = 0; v < rows; ++v) {
    for (uint32_t u = 0; u < columns; ++u) {
      const uint32_t u1 = (u + 1) % columns, v1 = (v + 1) % rows;
      add_quad(mesh, v * columns + u, v * columns + u1, v1 * columns + u1, v1 * columns + u);
    }
  }
  return mesh;
}

inline Mesh torus(double ring, double tube, uint32_t columns, uint32_t rows) {
  return closed_grid(columns, rows, [&](uint32_t u, uint32_t v) {
    const double a = 2 * std::numbers::pi * u / columns, b = 2 * std::numbers::pi * v / rows;
    const double r = ring + tube * std::cos(b);
    return Vec3{r * std::cos(a), r * std::sin(a), tube * std::sin(b)};
  });
}

// Returns a sphere: an octahedron whose triangles are divided into four `steps` times, with all vertices on the sphere.
inline Mesh sphere(double radius, int steps) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int step = 0; step < steps; ++step) {
    formats::VertexMerger merger;
    for (const Vec3& p : mesh.vertices) merger.add(p);
    const auto middle = [&](uint32_t a, uint32_t b) {
      const Vec3 sum = mesh.vertices[a] + mesh.vertices[b];
      return merger.add((1 / length(sum)) * sum);
    };
    std::vector<std::array<uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
    mesh.vertices = merger.take_places();
  }
  for (Vec3& p : mesh.vertices) p = radius * p;
  return mesh;
}

inline Mesh moved(Mesh mesh, const Affine& map) {
  for (Vec3& p : mesh.vertices) p = map(p);
  return mesh;
}

inline Mesh turned_inward(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  return mesh;
}

inline Mesh together(Mesh a, const Mesh& b) {
  const auto offset = static_cast<uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

// Returns a closed mesh that may intersect itself. Its coordinates are small integers, so vertices, edges and faces
// often lie on lattice planes.
inline Mesh random_on_lattice(std::mt19937& random, int reach) {
  std::uniform_int_distribution<int> coordinate(0, reach);
  const int kind = std::uniform_int_distribution<int>(0, 2)(random);
  Mesh mesh = kind == 0 ? cuboid({0, 0, 0}, {1, 1, 1}) : kind == 1 ? torus(2, 1, 5, 4) : sphere(1, 1);
  for (Vec3& p : mesh.vertices)
    p = {double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
  return mesh;
}

inline Affine random_affine(std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  for (;;) {
    Affine map;
    for (Vec3& row : map.rows) row = {entry(random), entry(random), entry(random)};
    map.offset = {entry(random), entry(random), entry(random)};
    if (std::abs(determinant(map)) > 0.05) return map;
  }
}

}  // namespace ombre::importing::test
