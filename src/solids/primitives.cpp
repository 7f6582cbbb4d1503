#include "solids/primitives.h"

#include <algorithm>
#include <numbers>

#include "base/math/math.h"
#include "formats/mesh/polygon.h"
#include "solids/fragments.h"
#include "solids/kernel.h"

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

// Removes indices that are no numbers of points, with a warning of each.
std::vector<size_t> valid_indices(const std::vector<size_t>& indices, size_t points, const std::string& list,
                                  size_t row, const SourceRange& where, Diagnostics& messages) {
  std::vector<size_t> valid;
  for (size_t n = 0; n < indices.size(); ++n) {
    if (indices[n] < points)
      valid.push_back(indices[n]);
    else
      messages.warning(where, "Point index " + std::to_string(indices[n]) + " is out of bounds (from " + list + "[" +
                                  std::to_string(row) + "][" + std::to_string(n) + "])");
  }
  return valid;
}

// Returns the largest triangle with the two corners that are farthest apart along an axis, as its area vector. Of equal
// ones, the first of the lowest and the last of the highest corners count.
Vec3 widest_triangle(const std::vector<Vec3>& corners) {
  int axis = 0;
  std::array<double, 3> extent{};
  std::array<Vec3, 2> ends;
  for (int n = 0; n < 3; ++n) {
    const auto [lo, hi] = std::ranges::minmax_element(corners, {}, [&](const Vec3& p) { return p[n]; });
    extent[static_cast<size_t>(n)] = (*hi)[n] - (*lo)[n];
    if (n > 0 && extent[static_cast<size_t>(n)] <= extent[static_cast<size_t>(axis)]) continue;
    axis = n;
    ends = {*lo, *hi};
  }
  Vec3 widest;
  for (const Vec3& p : corners) {
    const Vec3 area = cross(ends[0] - ends[1], p - ends[1]);
    if (dot(area, area) > dot(widest, widest)) widest = area;
  }
  return widest;
}

// Returns a face as OpenSCAD 2021.01 sees it, which matters if the face is not flat: without the coordinate along which
// its widest triangle points, and counter-clockwise.
Ring flattened(const std::vector<Vec3>& corners) {
  const Vec3 normal = widest_triangle(corners);
  int axis = 0;
  for (const int other : {1, 2})
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  Ring flat;
  for (const Vec3& p : corners) flat.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
  if (doubled_area(flat) < 0)
    for (Vec2& p : flat) p.y = -p.y;
  return flat;
}

// Returns 0 if OpenSCAD 2021.01 cuts a face with four corners from the first to the third, 1 if from the second to the
// last. A face that crosses itself is cut from the last corner, which is the first one in the script, and one with a
// concave corner from that. Else it first cuts from the second corner that a sweep meets, and takes the other diagonal
// where the angles opposite to the first are too large for Delaunay's triangles.
size_t diagonal_of(const Ring& flat) {
  std::vector<size_t> concave;
  for (size_t n = 0; n < 4; ++n)
    if (cross(flat[n] - flat[(n + 3) % 4], flat[(n + 1) % 4] - flat[n]) <= 0) concave.push_back(n);
  if (concave.size() > 1) return 1;
  if (concave.size() == 1) return concave[0] % 2;
  std::array<size_t, 4> order{0, 1, 2, 3};
  std::ranges::sort(
      order, [&](size_t a, size_t b) { return std::pair(flat[a].x, flat[a].y) < std::pair(flat[b].x, flat[b].y); });
  const auto angle = [&](size_t n) {
    const Vec2 a = flat[(n + 1) % 4] - flat[n], b = flat[(n + 3) % 4] - flat[n];
    return math::atan2(cross(a, b), dot(a, b));
  };
  const size_t from = order[1];
  constexpr double tolerance = 0.01;  // found by comparing thousands of faces
  const bool is_kept = angle((from + 1) % 4) + angle((from + 3) % 4) < std::numbers::pi + tolerance;
  return is_kept ? from % 2 : (from + 1) % 2;
}

bool is_flat(const std::vector<Vec3>& corners) {
  constexpr double rounding = 1e-9;
  Vec3 area;
  double size = 0;
  for (size_t n = 2; n < corners.size(); ++n) area = area + cross(corners[n - 1] - corners[0], corners[n] - corners[0]);
  for (const Vec3& p : corners) size = std::max(size, length(p - corners[0]));
  return std::ranges::all_of(
      corners, [&](const Vec3& p) { return std::abs(dot(area, p - corners[0])) <= rounding * size * length(area); });
}

// Cuts faces of polyhedra as OpenSCAD 2021.01 does.
class FaceCutter {
 public:
  std::vector<formats::Corners> cut(const std::vector<Vec3>& corners) {
    if (corners.size() == 3 || is_flat(corners)) return cutter_.cut(corners);
    const Ring flat = flattened(corners);
    if (corners.size() == 4) return diagonal_of(flat) == 0 ? from_first() : from_second();
    const std::array rings{flat};
    const PlaneTriangles pieces = kernel().triangulate(rings);
    const bool is_simple = pieces.crossings.empty() && pieces.triangles.size() == corners.size() - 2;
    return is_simple ? pieces.triangles : cutter_.cut(corners);
  }

 private:
  static std::vector<formats::Corners> from_first() { return {{0, 1, 2}, {0, 2, 3}}; }
  static std::vector<formats::Corners> from_second() { return {{1, 2, 3}, {1, 3, 0}}; }

  formats::PolygonCutter cutter_;
};

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
  FaceCutter cutter;
  for (size_t row = 0; row < polyhedron.faces.size(); ++row) {
    std::vector<size_t> face = valid_indices(polyhedron.faces[row], mesh.points.size(), "faces", row, where, messages);
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
    Ring& ring = rings.emplace_back();
    for (const size_t point : valid_indices(polygon.paths[row], polygon.points.size(), "paths", row, where, messages))
      ring.push_back(polygon.points[point]);
  }
  return rings;
}

}  // namespace ombre::solids
