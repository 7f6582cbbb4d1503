#include "solids/extrusions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>

#include "base/math/math.h"
#include "solids/fragments.h"
#include "solids/kernel.h"
#include "solids/regions.h"

namespace ombre::solids {
namespace {

using Side = std::pair<uint32_t, uint32_t>;  // from one point to the next, with the inside on the left

// A region as points, its boundary sides, and triangles that fill it.
struct Outline {
  std::vector<Vec2> points;
  std::vector<Side> sides;
  std::set<Side> sides_of_holes;
  std::vector<Triangle> triangles;
};

// Returns the edges that no other triangle has in the opposite direction.
std::vector<Side> sides_of(const std::vector<Triangle>& triangles) {
  std::set<Side> edges;
  for (const Triangle& t : triangles)
    for (size_t n = 0; n < 3; ++n) edges.insert({t[n], t[(n + 1) % 3]});
  std::vector<Side> sides;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) sides.push_back({a, b});
  return sides;
}

// Returns the outline of a region. The sides are those of its rings, cut where rings touch or cross.
Outline outline_of(const Region& region) {
  Outline outline;
  for (const Ring& ring : region.rings) {
    const auto first = static_cast<uint32_t>(outline.points.size());
    const bool is_hole = doubled_area(ring) < 0;
    for (uint32_t n = 0; n < ring.size(); ++n) {
      outline.points.push_back(ring[n]);
      outline.sides.push_back({first + n, first + (n + 1) % static_cast<uint32_t>(ring.size())});
      if (is_hole) outline.sides_of_holes.insert(outline.sides.back());
    }
  }
  PlaneTriangles filling = kernel().triangulate(region.rings);
  outline.points.insert(outline.points.end(), filling.crossings.begin(), filling.crossings.end());
  outline.triangles = std::move(filling.triangles);
  std::vector<Side> around = sides_of(outline.triangles), of_rings = outline.sides;
  std::ranges::sort(of_rings);
  if (around != of_rings) outline.sides = std::move(around);
  return outline;
}

// Returns the length of the longest path of a point. With twist, it combines the height with the length of a plane
// spiral, read from its outer to its inner end as if that were the outline's own size; this reproduces OpenSCAD
// 2021.01.
double longest_way(const Outline& outline, const LinearExtrude& by) {
  double radius = 0, shift = 0;
  for (const Vec2& p : outline.points) {
    radius = std::max(radius, length(p));
    shift = std::max(shift, length(Vec2{p.x * (by.scale.x - 1), p.y * (by.scale.y - 1)}));
  }
  if (by.twist == 0) return std::hypot(by.height, shift);
  constexpr int steps = 1000;
  const double scale = std::max(by.scale.x, by.scale.y), end = scale > 1 ? 1 / scale : scale;
  const double turn = by.twist * math::degree, growth = radius * (end - 1);
  double spiral = 0;
  for (int n = 0; n < steps; ++n) {
    const double here = radius + growth * (n + 0.5) / steps;
    spiral += std::sqrt(growth * growth + here * here * turn * turn) / steps;
  }
  return std::hypot(by.height, spiral);
}

int slices_of(const Outline& outline, const LinearExtrude& by) {
  if (by.slices) return std::clamp(*by.slices, 1, most_edges);
  const bool is_even = by.scale.x == by.scale.y;
  if (by.twist == 0 && is_even) return 1;
  const Fragments& fragments = by.fragments;
  constexpr double least_step = 0.01;
  const double turn = std::abs(by.twist);
  double count = 0;
  if (fragments.count > 0)
    count = turn > 0 ? std::max(3.0, std::floor(fragments.count)) * turn / 360 : std::floor(fragments.count);
  else {
    count = longest_way(outline, by) / std::max(fragments.size, least_step);
    if (turn > 0) count = std::min(count, turn / std::max(fragments.angle, least_step));
  }
  return static_cast<int>(std::clamp(std::ceil(count), 1.0, static_cast<double>(most_edges)));
}

// Divides the edges of a ring so that it has at least `count`; longer edges are divided more often.
Ring cut_edges(const Ring& ring, int count) {
  double around = 0;
  for (size_t n = 0; n < ring.size(); ++n) around += length(ring[(n + 1) % ring.size()] - ring[n]);
  Ring result;
  for (size_t n = 0; n < ring.size(); ++n) {
    const Vec2 along = ring[(n + 1) % ring.size()] - ring[n];
    const int pieces = std::max(1, static_cast<int>(std::ceil(count * length(along) / around - 1e-9)));
    for (int k = 0; k < pieces; ++k) result.push_back(ring[n] + (static_cast<double>(k) / pieces) * along);
  }
  return result;
}

class Extruder {
 public:
  Extruder(const Region& region, const LinearExtrude& by)
      : by_(by), outline_(outline_of(region)), slices_(slices_of(outline_, by)) {
    const double up = by.direction.z;
    along_ = (by.height / length(by.direction)) * by.direction;
    if (by.direction == Vec3{0, 0, up}) along_ = {0, 0, by.height};
    foot_ = by.centred ? -0.5 * along_ : Vec3{};
  }

  TriangleMesh make() {
    for (int n = 0; n <= slices_; ++n) add_slice(n);
    for (int n = 0; n < slices_; ++n) add_wall(n);
    if ((by_.scale.x == 0) != (by_.scale.y == 0)) cut_at_ridge(by_.scale.x == 0 ? 1 : 0);
    add_caps();
    return tidied(mesh_);
  }

 private:
  uint32_t count() const { return static_cast<uint32_t>(outline_.points.size()); }
  uint32_t number(int slice, uint32_t point) const { return static_cast<uint32_t>(slice) * count() + point; }
  const Vec3& at(int slice, uint32_t point) const { return mesh_.points[number(slice, point)]; }

  void add_slice(int n) {
    const double share = static_cast<double>(n) / slices_, turn = -by_.twist * share;
    const double c = degrees::cosine(turn), s = degrees::sine(turn);
    const Vec2 scale{1 + share * (by_.scale.x - 1), 1 + share * (by_.scale.y - 1)};
    for (const Vec2& p : outline_.points) {
      const Vec2 turned{c * p.x - s * p.y, s * p.x + c * p.y};
      mesh_.points.push_back(foot_ + share * along_ + Vec3{scale.x * turned.x, scale.y * turned.y, 0});
    }
  }

  // True if OpenSCAD 2021.01 cuts a wall's quadrilateral from the begin of its lower side to the end of its upper one:
  // that diagonal is the shorter one. Where the last slice is a line, it takes the other one.
  bool is_cut_rising(int n, const Side& side) const {
    const auto& [i, j] = side;
    const double rising = length(at(n + 1, j) - at(n, i)), falling = length(at(n + 1, i) - at(n, j));
    constexpr double rounding = 1e-9;
    const bool is_even = std::abs(rising - falling) <= rounding * (rising + falling);
    const bool is_usual = is_even ? (by_.twist > 0) != outline_.sides_of_holes.contains(side) : rising < falling;
    const bool ends_in_line = n + 1 == slices_ && (by_.scale.x == 0 || by_.scale.y == 0);
    return is_usual != ends_in_line;
  }

  void add_wall(int n) {
    for (const Side& side : outline_.sides) {
      const auto& [i, j] = side;
      const uint32_t a = number(n, i), b = number(n, j), c = number(n + 1, j), d = number(n + 1, i);
      if (is_cut_rising(n, side)) {
        mesh_.triangles.push_back({a, b, c});
        mesh_.triangles.push_back({a, c, d});
      } else {
        mesh_.triangles.push_back({a, b, d});
        mesh_.triangles.push_back({b, c, d});
      }
    }
  }

  // Cuts the triangles below a last slice that is a line along an axis at all points of that line. The edges of such a
  // slice lie on each other in part; cut, each has its counterparts.
  void cut_at_ridge(int axis) {
    std::map<double, uint32_t> ridge;
    for (uint32_t n = 0; n < count(); ++n) ridge.emplace(at(slices_, n)[axis], number(slices_, n));
    std::vector<Triangle> cut;
    for (Triangle t : mesh_.triangles) {
      const auto is_on_ridge = [&](uint32_t point) { return point >= number(slices_, 0); };
      for (int n = 0; n < 3 && !(is_on_ridge(t[0]) && is_on_ridge(t[1])); ++n)
        std::rotate(t.begin(), t.begin() + 1, t.end());
      if (!is_on_ridge(t[0]) || !is_on_ridge(t[1])) {
        cut.push_back(t);
        continue;
      }
      const double from = mesh_.points[t[0]][axis], to = mesh_.points[t[1]][axis];
      std::vector<uint32_t> way{t[0]};
      const auto beyond = ridge.lower_bound(std::max(from, to));
      if (from != to)
        for (auto between = ridge.upper_bound(std::min(from, to)); between != beyond; ++between)
          way.push_back(between->second);
      if (from > to) std::reverse(way.begin() + 1, way.end());
      way.push_back(t[1]);
      for (size_t n = 0; n + 1 < way.size(); ++n) cut.push_back({way[n], way[n + 1], t[2]});
    }
    mesh_.triangles = std::move(cut);
  }

  void add_caps() {
    for (const auto& [a, b, c] : outline_.triangles) mesh_.triangles.push_back({a, c, b});
    if (by_.scale.x == 0 || by_.scale.y == 0) return;
    for (const auto& [a, b, c] : outline_.triangles)
      mesh_.triangles.push_back({number(slices_, a), number(slices_, b), number(slices_, c)});
  }

  const LinearExtrude& by_;
  Outline outline_;
  int slices_;
  Vec3 along_, foot_;
  TriangleMesh mesh_;
};

// Builds the mesh of a profile revolved in steps.
class Revolver {
 public:
  Revolver(const Region& region, const RotateExtrude& by, double reach)
      : outline_(outline_of(region)), is_whole_(std::abs(by.angle) >= 360) {
    angle_ = is_whole_ ? 360 : by.angle;
    start_ = by.start.value_or(is_whole_ ? 180 : 0);
    const double edges = edges_of_circle(reach, by.fragments);
    steps_ = is_whole_ ? static_cast<int>(edges) : std::max(1, static_cast<int>(edges * std::abs(angle_) / 360));
    const double side = outline_.points.empty() ? 0
                                                : std::accumulate(outline_.points.begin(), outline_.points.end(), 0.0,
                                                                  [](double sum, const Vec2& p) { return sum + p.x; });
    turns_faces_ = (side < 0) != (angle_ < 0);
  }

  TriangleMesh make() {
    const int sections = is_whole_ ? steps_ : steps_ + 1;
    for (int n = 0; n < sections; ++n) add_section(n);
    for (int n = 0; n < steps_; ++n) add_wall(n, (n + 1) % sections);
    if (!is_whole_) add_ends();
    return tidied(mesh_);
  }

 private:
  uint32_t count() const { return static_cast<uint32_t>(outline_.points.size()); }

  void add_section(int n) {
    const double angle = start_ + angle_ * n / steps_;
    const double c = degrees::cosine(angle), s = degrees::sine(angle);
    for (const Vec2& p : outline_.points) mesh_.points.push_back({p.x * c, p.x * s, p.y});
  }

  void add(uint32_t a, uint32_t b, uint32_t c) {
    mesh_.triangles.push_back(turns_faces_ ? Triangle{a, c, b} : Triangle{a, b, c});
  }

  void add_wall(int n, int behind) {
    const uint32_t here = static_cast<uint32_t>(n) * count(), there = static_cast<uint32_t>(behind) * count();
    for (const auto& [i, j] : outline_.sides) {
      if (outline_.points[i].x == 0 && outline_.points[j].x == 0) continue;  // on the axis
      add(here + i, there + i, here + j);
      add(here + j, there + i, there + j);
    }
  }

  void add_ends() {
    const uint32_t last = static_cast<uint32_t>(steps_) * count();
    for (const auto& [a, b, c] : outline_.triangles) {
      add(a, b, c);
      add(last + a, last + c, last + b);
    }
  }

  Outline outline_;
  bool is_whole_, turns_faces_ = false;
  double angle_ = 360, start_ = 0;
  int steps_ = 1;
  TriangleMesh mesh_;
};

std::string two_digits(double number) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f", number);
  return text;
}

// Joins pieces to rings; each piece begins where another ends.
template <class Key>
std::vector<std::vector<Key>> chained(std::multimap<Key, Key>& next) {
  std::vector<std::vector<Key>> rings;
  while (!next.empty()) {
    std::vector<Key> ring;
    for (auto at = next.begin(); at != next.end(); at = next.find(ring.back())) {
      if (ring.empty()) ring.push_back(at->first);
      ring.push_back(at->second);
      next.erase(at);
    }
    ring.pop_back();
    rings.push_back(std::move(ring));
  }
  return rings;
}

// Distance below which gaps and slivers in the plane are removed; they arise because points of a solid are rounded.
constexpr double plane_noise_mm = 1e-6;

using Edge = std::pair<uint32_t, uint32_t>;  // from a point above the plane to one below

// Returns the rings in which the plane cuts a mesh; `counts_as_above` decides for points in the plane.
std::vector<Ring> cut(const TriangleMesh& mesh, bool counts_as_above) {
  const auto is_above = [&](uint32_t n) { return mesh.points[n].z > 0 || (counts_as_above && mesh.points[n].z == 0); };
  std::multimap<Edge, Edge> next;
  for (const Triangle& triangle : mesh.triangles) {
    Edge in, out;
    bool is_cut = false;
    for (int n = 0; n < 3; ++n) {
      const uint32_t a = triangle[n], b = triangle[(n + 1) % 3];
      if (is_above(a) == is_above(b)) continue;
      is_cut = true;
      (is_above(a) ? in : out) = is_above(a) ? Edge{a, b} : Edge{b, a};
    }
    if (is_cut) next.emplace(in, out);
  }
  std::vector<Ring> rings;
  for (const std::vector<Edge>& chain : chained(next)) {
    Ring& ring = rings.emplace_back();
    for (const auto& [above, below] : chain) {
      const Vec3 &p = mesh.points[above], &q = mesh.points[below];
      const double share = p.z == q.z ? 0 : p.z / (p.z - q.z);
      ring.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
    }
  }
  return rings;
}

}  // namespace

TriangleMesh extruded(const Region& region, const LinearExtrude& by) {
  if (region.is_empty() || !(by.height > 0) || !(by.direction.z > 0) || !std::isfinite(by.height)) return {};
  if (by.segments && *by.segments > 0) {
    Region finer = region;
    for (Ring& ring : finer.rings) ring = cut_edges(ring, std::min(*by.segments, most_edges));
    return Extruder(finer, by).make();
  }
  return Extruder(region, by).make();
}

TriangleMesh revolved(const Region& region, const RotateExtrude& by, const SourceRange& where, Diagnostics& messages) {
  if (region.is_empty() || by.angle == 0 || !std::isfinite(by.angle)) return {};
  const Box box = bounds_of(region);
  if (box.lo.x < 0 && box.hi.x > 0) {
    messages.error(where, "all points for rotate_extrude() must have the same X coordinate sign (range is " +
                              two_digits(box.lo.x) + " -> " + two_digits(box.hi.x) + ")");
    return {};
  }
  return Revolver(region, by, std::max(-box.lo.x, box.hi.x)).make();
}

Region section(const TriangleMesh& mesh) {
  const std::vector<Region> sides{wound_region_of(cut(mesh, true)), wound_region_of(cut(mesh, false))};
  return cleaned(unite(sides), plane_noise_mm);
}

// The number of upward faces above a point equals the number of rings of their border around it.
Region shadow(const TriangleMesh& mesh) {
  const auto faces_up = [&](const Triangle& t) {
    const Vec3 a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
    return cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{c.x - a.x, c.y - a.y}) > 0;
  };
  std::map<Edge, int> borders;
  for (const Triangle& t : mesh.triangles) {
    if (!faces_up(t)) continue;
    for (int n = 0; n < 3; ++n) {
      const Edge edge{t[n], t[(n + 1) % 3]};
      const auto other = borders.find({edge.second, edge.first});
      if (other == borders.end())
        ++borders[edge];
      else if (--other->second == 0)
        borders.erase(other);
    }
  }
  std::multimap<uint32_t, uint32_t> next;
  for (const auto& [edge, count] : borders)
    for (int n = 0; n < count; ++n) next.insert(edge);
  std::vector<Ring> rings;
  for (const std::vector<uint32_t>& chain : chained(next)) {
    Ring& ring = rings.emplace_back();
    for (const uint32_t point : chain) ring.push_back({mesh.points[point].x, mesh.points[point].y});
  }
  return cleaned(wound_region_of(rings), plane_noise_mm);
}

}  // namespace ombre::solids
