#include "surface/mesh/snap_to_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "surface/cells/quadric.h"

namespace ombre::surface {
namespace {

constexpr size_t fewest_vertices = 6;  // vertices that must lie exactly in a plane; three do in the plane of any facet
constexpr double least_share = 0.8;    // least share of a plane's vertices that must lie exactly in it
constexpr double rounding_of_exact = 0.1;  // vertices closer than this share of exact_mm are not moved
constexpr double least_area_mm2 = 1e-9;    // facets with less area have no usable normal

struct Plane {
  Vec3 at, normal;
  double off_mm(Vec3 p) const { return dot(p - at, normal); }
};

class PlaneSnapper {
 public:
  PlaneSnapper(RegionSurface& surface, double exact_mm, double near_mm, const Workers& workers)
      : surface_(surface),
        exact_mm_(exact_mm),
        near_mm_(near_mm),
        workers_(workers),
        facets_of_(surface.vertices.size()),
        seen_by_(surface.vertices.size(), none),
        tried_by_(surface.facets.size(), none),
        plane_of_(surface.facets.size(), none) {
    for (uint32_t n = 0; n < surface_.facets.size(); ++n)
      for (const uint32_t corner : surface_.facets[n].corners) facets_of_[corner].push_back(n);
  }

  void snap() {
    for (const uint32_t facet : largest_first()) {
      workers_.check_stop_at(facet);
      if (plane_of_[facet] == none) grow(facet);
    }
    for (uint32_t vertex = 0; vertex < facets_of_.size(); ++vertex) {
      workers_.check_stop_at(vertex);
      move(vertex);
    }
  }

 private:
  static constexpr uint32_t none = ~uint32_t{0};

  Vec3 at(uint32_t vertex) const { return surface_.vertices[vertex]; }
  // Returns the normal of a facet, with a length of twice its area.
  Vec3 normal(uint32_t facet) const {
    const auto& c = surface_.facets[facet].corners;
    return cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
  }

  std::vector<uint32_t> largest_first() const {
    std::vector<double> areas;
    for (uint32_t n = 0; n < surface_.facets.size(); ++n) areas.push_back(length(normal(n)));
    std::vector<uint32_t> order(areas.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) { return areas[a] > areas[b]; });
    return order;
  }

  // Collects the facets around the seed that lie near its plane, if they form a plane.
  void grow(uint32_t seed) {
    const Vec3 across = normal(seed);
    if (length(across) < least_area_mm2) return;
    const Plane plane{at(surface_.facets[seed].corners[0]), (1 / length(across)) * across};
    const auto is_near = [&](uint32_t facet) {
      return std::ranges::all_of(surface_.facets[facet].corners,
                                 [&](uint32_t v) { return std::abs(plane.off_mm(at(v))) <= near_mm_; });
    };
    std::vector<uint32_t> taken{seed};
    tried_by_[seed] = seed;
    size_t vertices = 0, exact = 0;
    for (size_t n = 0; n < taken.size(); ++n)
      for (const uint32_t vertex : surface_.facets[taken[n]].corners) {
        if (seen_by_[vertex] == seed) continue;
        seen_by_[vertex] = seed;
        ++vertices;
        if (std::abs(plane.off_mm(at(vertex))) <= exact_mm_) ++exact;
        for (const uint32_t other : facets_of_[vertex]) {
          if (tried_by_[other] == seed || plane_of_[other] != none || !is_near(other)) continue;
          tried_by_[other] = seed;
          taken.push_back(other);
        }
      }
    if (exact < fewest_vertices || static_cast<double>(exact) < least_share * static_cast<double>(vertices)) return;
    for (const uint32_t facet : taken) plane_of_[facet] = static_cast<uint32_t>(planes_.size());
    planes_.push_back(plane);
  }

  void move(uint32_t vertex) {
    std::vector<uint32_t> around;
    for (const uint32_t facet : facets_of_[vertex])
      if (plane_of_[facet] != none) around.push_back(plane_of_[facet]);
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    Quadric quadric;
    double farthest_mm = 0;
    for (const uint32_t n : around) {
      const double off_mm = planes_[n].off_mm(at(vertex));
      quadric.add(at(vertex) - off_mm * planes_[n].normal, planes_[n].normal);
      farthest_mm = std::max(farthest_mm, std::abs(off_mm));
    }
    if (farthest_mm <= rounding_of_exact * exact_mm_) return;
    const Vec3 before = at(vertex), after = quadric.least().at;
    if (length(after - before) <= 2 * near_mm_ && !turns(vertex, after)) surface_.vertices[vertex] = after;
  }

  // True if moving the vertex would turn a facet over.
  bool turns(uint32_t vertex, Vec3 to) const {
    return std::ranges::any_of(facets_of_[vertex], [&](uint32_t facet) {
      std::array<Vec3, 3> c;
      for (size_t n = 0; n < 3; ++n) {
        const uint32_t corner = surface_.facets[facet].corners[n];
        c[n] = corner == vertex ? to : at(corner);
      }
      const Vec3 was = normal(facet), is = cross(c[1] - c[0], c[2] - c[0]);
      return length(was) >= least_area_mm2 && dot(was, is) <= 0;
    });
  }

  RegionSurface& surface_;
  double exact_mm_, near_mm_;
  const Workers& workers_;
  std::vector<std::vector<uint32_t>> facets_of_;  // by vertex
  std::vector<uint32_t> seen_by_;                 // by vertex: the last seed whose search reached it
  std::vector<uint32_t> tried_by_, plane_of_;     // by facet
  std::vector<Plane> planes_;
};

}  // namespace

void snap_to_planes(RegionSurface& surface, double exact_mm, double near_mm, const Workers& workers) {
  PlaneSnapper(surface, exact_mm, near_mm, workers).snap();
}

}  // namespace ombre::surface
