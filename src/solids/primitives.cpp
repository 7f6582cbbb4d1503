#include "solids/primitives.h"

#include <algorithm>

#include "formats/mesh/polygon.h"
#include "solids/fragments.h"

namespace ombre::solids {
namespace {

bool is_length(double x) { return x > 0 && std::isfinite(x); }

Ring circle_ring(double radius, int edges) {
  Ring ring;
  for (int n = 0; n < edges; ++n) ring.push_back(on_circle(radius, 360.0 * n / edges));
  return ring;
}

// Fills a convex polygon, counter-clockwise from outside: cuts off every second corner, then every second of the
// remaining ones, and so on. Faces of other solids often lie in the same plane, and meet fewer of these triangles than
// of a fan.
void add_convex(std::span<const uint32_t> corners, TriangleMesh& mesh) {
  std::vector<uint32_t> left(corners.begin(), corners.end());
  while (left.size() > 2) {
    std::vector<uint32_t> next;
    for (size_t n = 0; n < left.size(); n += 2) {
      next.push_back(left[n]);
      if (n + 1 < left.size() && left.size() > 3)
        mesh.triangles.push_back({left[n], left[n + 1], left[(n + 2) % left.size()]});
    }
    if (left.size() == 3) {
      mesh.triangles.push_back({left[0], left[1], left[2]});
      return;
    }
    left = std::move(next);
  }
}

std::vector<uint32_t> numbers(uint32_t first, uint32_t count) {
  std::vector<uint32_t> result(count);
  for (uint32_t n = 0; n < count; ++n) result[n] = first + n;
  return result;
}

// Adds the wall between two rings with equal numbers of points, one above the other.
void add_wall(uint32_t below, uint32_t above, uint32_t count, TriangleMesh& mesh) {
  for (uint32_t n = 0; n < count; ++n) {
    const uint32_t next = (n + 1) % count;
    mesh.triangles.push_back({below + n, below + next, above + next});
    mesh.triangles.push_back({below + n, above + next, above + n});
  }
}

void add_ring(double radius, double z, int edges, TriangleMesh& mesh) {
  for (const Vec2& p : circle_ring(radius, edges)) mesh.points.push_back({p.x, p.y, z});
}

TriangleMesh cone(double radius, double foot, double tip, int edges) {
  TriangleMesh mesh;
  add_ring(radius, foot, edges, mesh);
  const auto count = static_cast<uint32_t>(edges);
  mesh.points.push_back({0, 0, tip});
  std::vector<uint32_t> base = numbers(0, count);
  const bool is_up = tip > foot;
  for (uint32_t n = 0; n < count; ++n) {
    const uint32_t next = (n + 1) % count;
    mesh.triangles.push_back(is_up ? Triangle{n, next, count} : Triangle{next, n, count});
  }
  if (is_up) std::reverse(base.begin(), base.end());
  add_convex(base, mesh);
  return mesh;
}

// Adds the walls between consecutive rings, and closes the first and last ring.
void close_rings(uint32_t rings, uint32_t count, TriangleMesh& mesh) {
  std::vector<uint32_t> bottom = numbers(0, count);
  std::reverse(bottom.begin(), bottom.end());
  add_convex(bottom, mesh);
  for (uint32_t n = 0; n + 1 < rings; ++n) add_wall(n * count, (n + 1) * count, count, mesh);
  add_convex(numbers((rings - 1) * count, count), mesh);
}

// Returns true if all indices of a face are numbers of points; otherwise reports the first that is not.
bool check_indices(const std::vector<size_t>& indices, size_t points, const std::string& list, size_t row,
                   const SourceRange& where, Diagnostics& messages) {
  for (size_t n = 0; n < indices.size(); ++n)
    if (indices[n] >= points) {
      messages.warning(where, "Point index " + std::to_string(indices[n]) + " is out of bounds (from " + list + "[" +
                                  std::to_string(row) + "][" + std::to_string(n) + "])");
      return false;
    }
  return true;
}

// True if OpenSCAD 2021.01 cuts a face with four corners from the second to the last. Which triangles it makes counts
// if the face is not flat: it cuts along the shorter diagonal as seen along the axis that its first three corners face
// most. Where the diagonals have one length, it cuts as a sweep does.
bool is_cut_from_second(const std::vector<Vec3>& corners) {
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[1]);
  int axis = 0;
  for (const int other : {1, 2})
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  std::array<Vec2, 4> flat;
  for (size_t n = 0; n < 4; ++n) {
    const double across = corners[n][(axis + 2) % 3];
    flat[n] = {corners[n][(axis + 1) % 3], normal[axis] < 0 ? -across : across};
  }
  for (size_t n = 0; n < 4; ++n)
    if (cross(flat[n] - flat[(n + 3) % 4], flat[(n + 1) % 4] - flat[n]) <= 0) return false;  // not convex
  constexpr double rounding = 1e-9;
  const double first = length(flat[2] - flat[0]), second = length(flat[3] - flat[1]);
  if (std::abs(first - second) > rounding * first) return second < first;
  std::array<size_t, 4> order{0, 1, 2, 3};
  std::ranges::sort(
      order, [&](size_t a, size_t b) { return std::pair(flat[a].x, flat[a].y) < std::pair(flat[b].x, flat[b].y); });
  const bool is_one_chain = (order[1] + 1) % 4 == order[2] || (order[2] + 1) % 4 == order[1];
  return (is_one_chain ? order[0] : order[1]) % 2 == 1;
}

}  // namespace

TriangleMesh mesh_of(const Cube& cube) {
  const Vec3& s = cube.size;
  TriangleMesh mesh;
  if (!is_length(s.x) || !is_length(s.y) || !is_length(s.z)) return mesh;
  const Vec3 lo = cube.centred ? -0.5 * s : Vec3{}, hi = cube.centred ? 0.5 * s : s;
  for (const double z : {lo.z, hi.z})
    for (const Vec2 p : {Vec2{lo.x, lo.y}, Vec2{hi.x, lo.y}, Vec2{hi.x, hi.y}, Vec2{lo.x, hi.y}})
      mesh.points.push_back({p.x, p.y, z});
  close_rings(2, 4, mesh);
  return mesh;
}

TriangleMesh mesh_of(const Sphere& sphere) {
  TriangleMesh mesh;
  if (!is_length(sphere.radius)) return mesh;
  const int edges = edges_of_circle(sphere.radius, sphere.fragments), rings = (edges + 1) / 2;
  for (int n = rings - 1; n >= 0; --n) {
    const double from_pole = 180.0 * (n + 0.5) / rings;
    add_ring(sphere.radius * degrees::sine(from_pole), sphere.radius * degrees::cosine(from_pole), edges, mesh);
  }
  close_rings(static_cast<uint32_t>(rings), static_cast<uint32_t>(edges), mesh);
  return mesh;
}

TriangleMesh mesh_of(const Cylinder& cylinder) {
  const double below = cylinder.bottom_radius, above = cylinder.top_radius;
  TriangleMesh mesh;
  if (!is_length(cylinder.height) || !(below >= 0) || !(above >= 0) || !is_length(below + above)) return mesh;
  const int edges = edges_of_circle(std::max(below, above), cylinder.fragments);
  const double foot = cylinder.centred ? -cylinder.height / 2 : 0, top = foot + cylinder.height;
  if (above == 0) return cone(below, foot, top, edges);
  if (below == 0) return cone(above, top, foot, edges);
  add_ring(below, foot, edges, mesh);
  add_ring(above, top, edges, mesh);
  close_rings(2, static_cast<uint32_t>(edges), mesh);
  return mesh;
}

TriangleMesh mesh_of(const Polyhedron& polyhedron, const SourceRange& where, Diagnostics& messages) {
  TriangleMesh mesh{polyhedron.points, {}};
  formats::PolygonCutter cutter;
  for (size_t row = 0; row < polyhedron.faces.size(); ++row) {
    std::vector<size_t> face = polyhedron.faces[row];
    if (!check_indices(face, mesh.points.size(), "faces", row, where, messages)) continue;
    std::ranges::reverse(face);  // counter-clockwise from outside
    std::vector<Vec3> corners;
    std::vector<uint32_t> number;
    for (const size_t corner : face) {
      if (!corners.empty() && mesh.points[corner] == corners.back()) continue;
      corners.push_back(mesh.points[corner]);
      number.push_back(static_cast<uint32_t>(corner));
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3) continue;
    if (corners.size() == 4 && is_cut_from_second(corners)) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      std::rotate(number.begin(), number.begin() + 1, number.begin() + 4);
    }
    for (const auto& [a, b, c] : cutter.cut(corners)) mesh.triangles.push_back({number[a], number[b], number[c]});
  }
  return tidied(mesh);
}

std::vector<Ring> rings_of(const Square& square) {
  const Vec2& s = square.size;
  if (!is_length(s.x) || !is_length(s.y)) return {};
  const Vec2 lo = square.centred ? -0.5 * s : Vec2{}, hi = square.centred ? 0.5 * s : s;
  return {{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}};
}

std::vector<Ring> rings_of(const Circle& circle) {
  if (!is_length(circle.radius)) return {};
  return {circle_ring(circle.radius, edges_of_circle(circle.radius, circle.fragments))};
}

std::vector<Ring> rings_of(const Polygon& polygon, const SourceRange& where, Diagnostics& messages) {
  if (polygon.paths.empty()) return {polygon.points};
  std::vector<Ring> rings;
  for (size_t row = 0; row < polygon.paths.size(); ++row) {
    const std::vector<size_t>& path = polygon.paths[row];
    if (!check_indices(path, polygon.points.size(), "paths", row, where, messages)) continue;
    Ring& ring = rings.emplace_back();
    for (const size_t point : path) ring.push_back(polygon.points[point]);
  }
  return rings;
}

}  // namespace ombre::solids
