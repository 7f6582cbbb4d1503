#include "jobs/characterise/surface_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace ombre::compile {
namespace {

using Corner = std::tuple<double, double, double>;
using Facet = std::array<Corner, 3>;

double area_of(const std::array<Vec3, 3>& p) { return 0.5 * length(cross(p[1] - p[0], p[2] - p[0])); }

// Returns the corners in an order that neighbours on both sides share.
Facet facet_of(const std::array<Vec3, 3>& p) {
  Facet facet;
  for (size_t n = 0; n < 3; ++n) facet[n] = {p[n].x, p[n].y, p[n].z};
  std::ranges::sort(facet);
  return facet;
}

// Returns the axis across which the box has the face that holds the facet, or nothing. Vertices may be half a cell off
// the face, since they are placed to suit all surfaces that meet there.
std::optional<size_t> face_of(const std::array<Vec3, 3>& p, const Box& box, double cell_mm) {
  constexpr double about_parallel = 0.95;
  const Vec3 across = cross(p[1] - p[0], p[2] - p[0]);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(across[axis]) < about_parallel * length(across)) continue;
    for (const double face : {box.lo[axis], box.hi[axis]})
      if (std::ranges::all_of(p, [&](const Vec3& corner) { return std::abs(corner[axis] - face) < cell_mm / 2; }))
        return static_cast<size_t>(axis);
  }
  return std::nullopt;
}

}  // namespace

Surfaces surfaces_of(const MeshedDesign& meshed, const Box& box, const Periodic& periodic) {
  Surfaces found;
  std::map<Facet, size_t> open;  // facets of earlier bodies that no other body has yet
  for (size_t n = 0; n < meshed.bodies.size(); ++n) {
    const RegionBody& one = meshed.bodies[n];
    found.volume_mm3 += one.volume_mm3;
    found.material_mm3[one.region.name] += one.volume_mm3;
    for (const auto& triangle : one.body.triangles) {
      const std::array<Vec3, 3> p{one.body.vertices[triangle[0]], one.body.vertices[triangle[1]],
                                  one.body.vertices[triangle[2]]};
      const double area = area_of(p);
      if (const auto axis = face_of(p, box, meshed.cell_mm)) {
        if (!periodic[*axis]) found.surface_mm2 += area;
        continue;
      }
      const auto [other, is_new] =
          meshed.bodies.size() > 1 ? open.try_emplace(facet_of(p), n) : std::pair(open.end(), true);
      found.inner_mm2 += is_new ? area : -area;
      if (is_new) continue;
      const std::string names = meshed.bodies[other->second].region.name + ", " + one.region.name;
      found.interface_mm2[names] += area;
      open.erase(other);
    }
  }
  found.surface_mm2 += found.inner_mm2;
  return found;
}

}  // namespace ombre::compile
