#include "surface/mesh/bodies.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ombre::surface {
namespace {

using Triangle = std::array<uint32_t, 3>;

std::vector<Triangle> triangles_around(const RegionSurface& surface, Label region) {
  std::vector<Triangle> triangles;
  for (const Facet& f : surface.facets) {
    if (f.back == region) triangles.push_back(f.corners);
    if (f.front == region) triangles.push_back({f.corners[0], f.corners[2], f.corners[1]});
  }
  return triangles;
}

// One side of a triangle, from corner `side` to the next corner.
struct HalfEdge {
  uint32_t low, high;  // vertices at its ends
  uint32_t triangle;
  uint8_t side;
  bool is_forward;  // true if the triangle runs from `low` to `high`
  double angle = 0;
};

class Manifold {
 public:
  Manifold(const RegionSurface& surface, std::vector<Triangle> triangles)
      : surface_(surface), triangles_(std::move(triangles)), class_(3 * triangles_.size()) {
    std::iota(class_.begin(), class_.end(), 0U);
  }

  Body make() {
    join_along_edges();
    std::vector<uint32_t> number(class_.size(), none), vertex_of(class_.size());
    std::vector<std::pair<uint32_t, uint32_t>> order;  // pairs of the surface's vertex and the class
    for (uint32_t corner = 0; corner < class_.size(); ++corner)
      if (find(corner) == corner) order.emplace_back(triangles_[corner / 3][corner % 3], corner);
    std::ranges::sort(order);
    Body body;
    for (const auto& [vertex, corner] : order) {
      number[corner] = static_cast<uint32_t>(body.vertices.size());
      body.vertices.push_back(surface_.vertices[vertex]);
    }
    for (uint32_t t = 0; t < triangles_.size(); ++t)
      body.triangles.push_back({number[find(3 * t)], number[find(3 * t + 1)], number[find(3 * t + 2)]});
    return body;
  }

 private:
  static constexpr uint32_t none = ~uint32_t{0};

  std::vector<HalfEdge> half_edges() const {
    std::vector<HalfEdge> edges;
    edges.reserve(class_.size());
    for (uint32_t t = 0; t < triangles_.size(); ++t)
      for (uint8_t side = 0; side < 3; ++side) {
        const uint32_t a = triangles_[t][side], b = triangles_[t][(side + 1U) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), t, side, a < b});
      }
    std::ranges::sort(edges, {}, [](const HalfEdge& e) { return std::tuple(e.low, e.high, e.triangle, e.side); });
    return edges;
  }

  void join_along_edges() {
    std::vector<HalfEdge> edges = half_edges();
    for (size_t begin = 0; begin < edges.size();) {
      size_t end = begin + 1;
      while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
      if (end - begin == 2)
        join(edges[begin], edges[begin + 1]);
      else
        join_wedges(
            {edges.begin() + static_cast<std::ptrdiff_t>(begin), edges.begin() + static_cast<std::ptrdiff_t>(end)});
      begin = end;
    }
  }

  // Joins the corners of pairs of triangles at an edge with more than two triangles: each pair encloses a wedge of
  // solid.
  void join_wedges(std::vector<HalfEdge> fan) {
    const Vec3 low = surface_.vertices[fan[0].low], high = surface_.vertices[fan[0].high];
    const Vec3 along = high - low, u = third(fan[0]) - low;
    const Vec3 v = cross(along, u), w = cross(v, along);
    for (HalfEdge& e : fan) e.angle = std::atan2(dot(third(e) - low, v) * length(along), dot(third(e) - low, w));
    std::ranges::stable_sort(fan, {}, &HalfEdge::angle);
    // Solid lies counter-clockwise from a triangle that is not forward, up to the next one that is.
    for (size_t left = fan.size(); left >= 2; left -= 2) {
      size_t n = 0;
      while (n < fan.size() && (fan[n].is_forward || !fan[(n + 1) % fan.size()].is_forward)) ++n;
      if (n == fan.size()) return;
      join(fan[n], fan[(n + 1) % fan.size()]);
      const size_t next = (n + 1) % fan.size();
      fan.erase(fan.begin() + static_cast<std::ptrdiff_t>(std::max(n, next)));
      fan.erase(fan.begin() + static_cast<std::ptrdiff_t>(std::min(n, next)));
    }
  }

  Vec3 third(const HalfEdge& e) const { return surface_.vertices[triangles_[e.triangle][(e.side + 2U) % 3]]; }

  // Joins the corners of both triangles at each end of an edge into one vertex.
  void join(const HalfEdge& a, const HalfEdge& b) {
    const auto corner = [](const HalfEdge& e, bool at_low) {
      return 3 * e.triangle + (e.is_forward == at_low ? e.side : (e.side + 1U) % 3);
    };
    join(corner(a, true), corner(b, true));
    join(corner(a, false), corner(b, false));
  }
  void join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    class_[std::max(a, b)] = std::min(a, b);
  }
  uint32_t find(uint32_t corner) {
    while (class_[corner] != corner) corner = class_[corner] = class_[class_[corner]];
    return corner;
  }

  const RegionSurface& surface_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> class_;  // union-find parents of corners; corners in one class become one vertex
};

}  // namespace

Body body_of(const RegionSurface& surface, Label region) {
  return Manifold(surface, triangles_around(surface, region)).make();
}

double volume_mm3(const Body& body) {
  double six_times = 0;
  for (const Triangle& t : body.triangles)
    six_times += dot(body.vertices[t[0]], cross(body.vertices[t[1]], body.vertices[t[2]]));
  return six_times / 6;
}

double area_mm2(const Body& body) {
  double twice = 0;
  for (const Triangle& t : body.triangles) {
    const Vec3 a = body.vertices[t[0]];
    twice += length(cross(body.vertices[t[1]] - a, body.vertices[t[2]] - a));
  }
  return twice / 2;
}

}  // namespace ombre::surface
