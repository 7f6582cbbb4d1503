#include "import/charts/surface_rays.h"

#include <cmath>
#include <optional>

#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

// Returns the length of the way along a direction to a triangle (T. Möller and B. Trumbore, "Fast, minimum storage
// ray-triangle intersection", Journal of Graphics Tools 2, 1997), or nothing if it misses. Edges belong to the
// triangle.
std::optional<double> length_to(const std::array<Vec3, 3>& t, Vec3 p, Vec3 direction) {
  constexpr double room = 1e-9;  // so that no ray passes between two triangles
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0], across = cross(direction, e2), from = p - t[0];
  const double turn = dot(e1, across);
  if (turn == 0) return std::nullopt;
  const double first = dot(from, across) / turn;
  const Vec3 other = cross(from, e1);
  const double second = dot(direction, other) / turn, along = dot(e2, other) / turn;
  if (first < -room || second < -room || first + second > 1 + room || along < 0) return std::nullopt;
  return along;
}

Vec3 nearest_on(const std::array<Vec3, 3>& t, Vec3 p) {
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0], n = cross(e1, e2), q = p - t[0];
  const double squared = dot(n, n);
  if (squared > 0) {
    const double b = dot(cross(q, e2), n) / squared, c = dot(cross(e1, q), n) / squared;
    if (b >= 0 && c >= 0 && b + c <= 1) return t[0] + b * e1 + c * e2;
  }
  Vec3 best = t[0];
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 a = t[i], way = t[(i + 1) % 3] - a;
    const double whole = dot(way, way);
    const Vec3 at = whole > 0 ? a + std::clamp(dot(p - a, way) / whole, 0.0, 1.0) * way : a;
    if (length(at - p) < length(best - p)) best = at;
  }
  return best;
}

}  // namespace

SurfaceRays::SurfaceRays(const std::vector<Vec3>& points, const std::vector<Corners>& triangles) {
  std::vector<Box> boxes;
  for (const auto& [a, b, c] : triangles) {
    triangles_.push_back({points[a], points[b], points[c]});
    boxes.push_back(box_of(triangles_.back()));
  }
  tree_ = BoxTree(boxes);
}

double SurfaceRays::distance(Vec3 p) const {
  return tree_.nearest(p, Box::inf, 0, [&](uint32_t n) { return std::sqrt(squared_distance(p, triangles_[n])); });
}

Vec3 SurfaceRays::way_from(Vec3 p, Vec3 direction) const {
  constexpr double most_distances = 3;
  double least = Box::inf;
  uint32_t nearest = 0;
  tree_.nearest(p, Box::inf, 0, [&](uint32_t n) {
    const double here = std::sqrt(squared_distance(p, triangles_[n]));
    if (here < least || (here == least && n < nearest)) {
      least = here;
      nearest = n;
    }
    return here;
  });
  const double reach = most_distances * least;
  const Vec3 end = p + reach * direction;
  double first = Box::inf;
  tree_.each_that_meets(hull(Box{p, p}, Box{end, end}), [&](uint32_t n) {
    const auto along = length_to(triangles_[n], p, direction);
    if (along && *along <= reach) first = std::min(first, *along);
  });
  return first < Box::inf ? first * direction : nearest_on(triangles_[nearest], p) - p;
}

}  // namespace ombre::importing
