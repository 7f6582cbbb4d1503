#include "nodes/solids/plane_polygons.h"

#include <algorithm>

#include "base/text/text.h"
#include "nodes/common/repeated_points.h"

namespace ombre::nodes {
namespace {

using design::Points;
using design::Reader;

// Tolerances relative to the size of the polygon.
constexpr double flattest_area = 1e-8, farthest_from_plane = 1e-6;

// Returns a vector normal to the plane of the points, whose length is twice their area.
Vec3 area_vector(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (size_t n = 0; n < points.size(); ++n)
    sum = sum + cross(points[n] - points[0], points[(n + 1) % points.size()] - points[0]);
  return sum;
}

// Returns a right-handed frame of the plane, whose origin is the plane's point nearest to the origin.
Affine plane_frame(Vec3 normal, double offset) {
  int flattest = 0;
  for (const int axis : {1, 2})
    if (std::abs(normal[axis]) < std::abs(normal[flattest])) flattest = axis;
  Vec3 u;
  u[flattest] = 1;
  u = u - normal[flattest] * normal;
  u = (1 / length(u)) * u;
  const Vec3 v = cross(normal, u);
  return {{Vec3{u.x, v.x, normal.x}, Vec3{u.y, v.y, normal.y}, Vec3{u.z, v.z, normal.z}}, offset * normal};
}

std::optional<Affine> plane_of(const Points& outer, const Reader& reader) {
  if (outer.are_flat) return Affine{};
  const Vec3 area = area_vector(outer.at);
  const double size = size_of(outer.at);
  if (!(length(area) > flattest_area * size * size)) {
    reader.refuse("the points of " + std::string(reader.node) + " lie on a line, or go round no area");
    return std::nullopt;
  }
  const Vec3 normal = (1 / length(area)) * area;
  double offset = 0;
  for (const Vec3& p : outer.at) offset += dot(normal, p) / static_cast<double>(outer.at.size());
  return plane_frame(normal, offset);
}

std::optional<Ring> laid(const Points& points, const Affine& plane_from_here, double room, const std::string& what,
                         const Reader& reader) {
  Ring ring;
  size_t worst = 0;
  double farthest = 0;  // greatest distance from the plane
  for (size_t n = 0; n < points.at.size(); ++n) {
    const Vec3 p = plane_from_here(points.at[n]);
    ring.push_back({p.x, p.y});
    if (std::abs(p.z) <= farthest) continue;
    farthest = std::abs(p.z);
    worst = n;
  }
  if (farthest > room) {
    reader.refuse("point " + std::to_string(worst + 1) + " of " + what + " lies " + format_rounded(farthest) +
                      " mm off the plane of the others",
                  "all points of a polygon and its holes lie in one plane");
    return std::nullopt;
  }
  return checked_ring(std::move(ring), what, reader);
}

}  // namespace

std::optional<Ring> checked_ring(Ring ring, const std::string& what, const Reader& reader) {
  Box box;
  for (const Vec2 p : ring) box = hull(box, Box{{p.x, p.y, 0}, {p.x, p.y, 0}});
  ring = without_repeated(ring, length(box.size()), true);
  if (ring.size() < 3) {
    reader.refuse(what + " needs at least 3 points, found " + std::to_string(ring.size()));
    return std::nullopt;
  }
  const Vec2 first = ring[1] - ring[0];
  const bool are_on_line = std::all_of(ring.begin(), ring.end(), [&](Vec2 p) {
    return std::abs(cross(first, p - ring[0])) <= flattest_area * length(first) * length(box.size());
  });
  if (!are_on_line) return ring;
  reader.refuse("the points of " + what + " lie on a line, or go round no area");
  return std::nullopt;
}

std::optional<PlanePolygons> PlanePolygons::read(const Points& outer, const std::vector<Points>& holes,
                                                 const Reader& reader) {
  if (outer.at.size() < 3) {
    reader.refuse(std::string(reader.node) + " needs at least 3 points, found " + std::to_string(outer.at.size()));
    return std::nullopt;
  }
  const auto plane = plane_of(outer, reader);
  if (!plane) return std::nullopt;
  PlanePolygons result{{}, *plane};
  const Affine plane_from_here = inverse(*plane);
  const double room = farthest_from_plane * size_of(outer.at);
  const auto ring = laid(outer, plane_from_here, room, std::string(reader.node), reader);
  if (!ring) return std::nullopt;
  result.polygons.solid.push_back(*ring);
  for (size_t n = 0; n < holes.size(); ++n) {
    if (holes[n].at.empty()) continue;
    auto hole = laid(holes[n], plane_from_here, room, "hole " + std::to_string(n + 1), reader);
    if (!hole) return std::nullopt;
    result.polygons.holes.push_back(std::move(*hole));
  }
  return result;
}

}  // namespace ombre::nodes
