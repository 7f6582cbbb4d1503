#ifdef OMBRE_POLYGONS

#include "solids/regions.h"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

#include "base/text/error.h"
#include "solids/fragments.h"

namespace ombre::solids {
namespace {

namespace clip = ClipperLib;
using clip::IntPoint;
using clip::Path;
using clip::Paths;

// Converts between millimetres and the integers of the polygon library.
class Grid {
 public:
  // Constructs a grid; `reach_mm` is the greatest coordinate.
  explicit Grid(double reach_mm) {
    constexpr int finest = 32;
    int exponent = 0;
    std::frexp(reach_mm, &exponent);
    constexpr int bits = 56;  // the library's own limit is 62
    steps_ = std::ldexp(1.0, std::min(finest, bits - std::max(0, exponent)));
  }

  Path path(const Ring& ring) const {
    Path result;
    result.reserve(ring.size());
    for (const Vec2& p : ring) {
      const IntPoint next(std::llround(p.x * steps_), std::llround(p.y * steps_));
      if (result.empty() || result.back() != next) result.push_back(next);
    }
    while (result.size() > 1 && result.front() == result.back()) result.pop_back();
    return result;
  }

  Paths paths(std::span<const Ring> rings) const {
    Paths result;
    for (const Ring& ring : rings) result.push_back(path(ring));
    return result;
  }

  Region region(const Paths& paths) const {
    Region result;
    for (const Path& path : paths) {
      if (path.size() < 3) continue;
      Ring& ring = result.rings.emplace_back();
      for (const IntPoint& p : path)
        ring.push_back({static_cast<double>(p.X) / steps_, static_cast<double>(p.Y) / steps_});
    }
    return result;
  }

  double steps() const { return steps_; }

 private:
  double steps_;
};

double reach_of(std::span<const Ring> rings) {
  double reach = 1;
  for (const Ring& ring : rings)
    for (const Vec2& p : ring) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  constexpr double farthest = 1e15;
  if (!(reach <= farthest)) throw Error(Code::limit, "a region of the plane reaches farther than 10^15 mm");
  return reach;
}

// Removes corners at which a path goes straight on, which the library leaves where sides of both operands met. So does
// OpenSCAD, and it shows in extrusions with a twist.
void remove_straight_corners(Path& path) {
  const auto is_straight = [](const IntPoint& a, const IntPoint& b, const IntPoint& c) {
    __extension__ using Wide = __int128;
    return Wide{b.X - a.X} * Wide{c.Y - b.Y} == Wide{b.Y - a.Y} * Wide{c.X - b.X};
  };
  Path kept;
  for (size_t n = 0; n < path.size(); ++n) {
    const IntPoint& before = kept.empty() ? path.back() : kept.back();
    if (!is_straight(before, path[n], path[(n + 1) % path.size()])) kept.push_back(path[n]);
  }
  path = std::move(kept);
}

Region combine(clip::ClipType operation, std::span<const Ring> subject, std::span<const Ring> other,
               clip::PolyFillType rule) {
  const Grid grid(std::max(reach_of(subject), reach_of(other)));
  clip::Clipper clipper;
  clipper.StrictlySimple(true);
  clipper.AddPaths(grid.paths(subject), clip::ptSubject, true);
  clipper.AddPaths(grid.paths(other), clip::ptClip, true);
  Paths result;
  clipper.Execute(operation, result, rule, rule);
  for (Path& path : result) remove_straight_corners(path);
  return grid.region(result);
}

std::vector<Ring> all_rings(std::span<const Region> regions) {
  std::vector<Ring> rings;
  for (const Region& region : regions) rings.insert(rings.end(), region.rings.begin(), region.rings.end());
  return rings;
}

std::vector<Ring> shifted(const std::vector<Ring>& rings, Vec2 by) {
  std::vector<Ring> result = rings;
  for (Ring& ring : result)
    for (Vec2& p : ring) p = p + by;
  return result;
}

Ring hull_ring(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  Ring ring;
  const auto add = [&](Vec2 p, size_t least) {
    while (ring.size() > least && cross(ring.back() - ring[ring.size() - 2], p - ring.back()) <= 0) ring.pop_back();
    ring.push_back(p);
  };
  for (const Vec2& p : points) add(p, 1);
  const size_t lower = ring.size();
  for (size_t n = points.size() - 1; n-- > 0;) add(points[n], lower);
  ring.pop_back();
  return ring.size() < 3 ? Ring{} : ring;
}

bool is_convex(const Region& region) {
  return region.rings.size() == 1 && region.rings[0].size() == hull_ring(region.rings[0]).size();
}

Ring convex_sum(const Ring& a, const Ring& b) {
  std::vector<Vec2> sums;
  for (const Vec2& p : a)
    for (const Vec2& q : b) sums.push_back(p + q);
  return hull_ring(std::move(sums));
}

// Appends the parallelograms between the edges of two rings, turned counter-clockwise. They cover the points of the sum
// at which the borders meet.
void add_parallelograms(const Ring& a, const Ring& b, std::vector<Ring>& out) {
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b.size(); ++j) {
      const Vec2 p = a[i], p1 = a[(i + 1) % a.size()], q = b[j], q1 = b[(j + 1) % b.size()];
      Ring quad{p + q, p1 + q, p1 + q1, p + q1};
      const double turn = doubled_area(quad);
      if (turn < 0) std::reverse(quad.begin(), quad.end());
      if (turn != 0) out.push_back(std::move(quad));
    }
}

clip::JoinType join_of(const Offset& by) {
  return by.round ? clip::jtRound : by.chamfer ? clip::jtSquare : clip::jtMiter;
}

}  // namespace

Region region_of(std::span<const Ring> rings) { return combine(clip::ctUnion, rings, {}, clip::pftEvenOdd); }
Region wound_region_of(std::span<const Ring> rings) { return combine(clip::ctUnion, rings, {}, clip::pftNonZero); }

Region unite(std::span<const Region> regions) {
  if (regions.size() == 1) return regions[0];
  return wound_region_of(all_rings(regions));
}

Region intersect(const Region& a, const Region& b) {
  return combine(clip::ctIntersection, a.rings, b.rings, clip::pftNonZero);
}

Region subtract(const Region& a, const Region& b) {
  if (b.is_empty()) return a;
  return combine(clip::ctDifference, a.rings, b.rings, clip::pftNonZero);
}

Region moved(const Region& region, const Affine& map) {
  const double turn = map.rows[0].x * map.rows[1].y - map.rows[0].y * map.rows[1].x;
  Region result;
  if (turn == 0) return result;
  result = region;
  for (Ring& ring : result.rings) {
    for (Vec2& p : ring) {
      const Vec3 image = map({p.x, p.y, 0});
      p = {image.x, image.y};
    }
    if (turn < 0) std::reverse(ring.begin(), ring.end());
  }
  return result;
}

Region offset(const Region& region, const Offset& by) {
  if (region.is_empty() || by.distance == 0) return region;
  // Corners of edges moved by d lie within d / sin(a / 2) of their old place; needles would be unbounded without a
  // limit.
  constexpr double longest_corner = 1e6;
  const double reach = reach_of(region.rings) + 8 * std::abs(by.distance);
  const Grid grid(reach);
  const double distance = by.distance * grid.steps();
  const double sagitta =
      std::abs(distance) * (1 - degrees::cosine(180.0 / edges_of_circle(std::abs(by.distance), by.fragments)));
  clip::ClipperOffset offsetter(longest_corner, sagitta);
  offsetter.AddPaths(grid.paths(region.rings), join_of(by), clip::etClosedPolygon);
  Paths result;
  offsetter.Execute(result, distance);
  return grid.region(result);
}

Region cleaned(const Region& region, double distance_mm) {
  const Grid grid(reach_of(region.rings));
  Paths paths = grid.paths(region.rings);
  clip::CleanPolygons(paths, distance_mm * grid.steps());
  return wound_region_of(grid.region(paths).rings);
}

Region fill(const Region& region) {
  std::vector<Ring> outer;
  for (const Ring& ring : region.rings)
    if (doubled_area(ring) > 0) outer.push_back(ring);
  return wound_region_of(outer);
}

Region hull(std::span<const Region> regions) {
  std::vector<Vec2> points;
  for (const Region& region : regions)
    for (const Ring& ring : region.rings) points.insert(points.end(), ring.begin(), ring.end());
  Ring ring = hull_ring(std::move(points));
  if (ring.empty()) return {};
  return {{std::move(ring)}};
}

// x is in the sum if a meets the mirrored b moved to x: then their borders cross, or a ring of one lies inside of the
// other. So the sum is the area swept by the borders, united with each region moved to one point of each ring of the
// other.
Region minkowski(const Region& a, const Region& b) {
  if (a.is_empty() || b.is_empty()) return {};
  if (is_convex(a) && is_convex(b)) return {{convex_sum(a.rings[0], b.rings[0])}};
  std::vector<Ring> all;
  for (const Ring& of_a : a.rings)
    for (const Ring& of_b : b.rings) add_parallelograms(of_a, of_b, all);
  std::vector<Region> parts{wound_region_of(all)};
  for (const Ring& of_a : a.rings) parts.push_back({shifted(b.rings, of_a[0])});
  for (const Ring& of_b : b.rings) parts.push_back({shifted(a.rings, of_b[0])});
  return wound_region_of(all_rings(parts));
}

}  // namespace ombre::solids

#endif
