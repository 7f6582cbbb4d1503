#include "formats/drawings/hatches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/math/math.h"

namespace ombre::formats {
namespace {

// The cosine and the sine of an angle, exact at quarter turns.
Vec2 direction_at(double degrees) {
  const double turn = degrees - 360 * std::floor(degrees / 360);
  if (turn == 0) return {1, 0};
  if (turn == 90) return {0, 1};
  if (turn == 180) return {-1, 0};
  if (turn == 270) return {0, -1};
  const double radians = turn * std::numbers::pi / 180;
  return {math::cos(radians), math::sin(radians)};
}

// The places along each ray, by its number, at which it crosses an edge.
using Crossings = std::map<int64_t, std::vector<double>>;

// Adds the crossings of an edge, which holds its beginning but not its end; coordinates are along and across rays.
void add_edge(Vec2 a, Vec2 b, double spacing, Crossings& crossings) {
  if (a.y > b.y) std::swap(a, b);
  const auto first = static_cast<int64_t>(std::ceil(a.y / spacing - 0.5));
  for (int64_t ray = first;; ++ray) {
    const double across = (static_cast<double>(ray) + 0.5) * spacing;
    if (across < a.y) continue;
    if (across >= b.y) return;
    crossings[ray].push_back(a.x + (across - a.y) / (b.y - a.y) * (b.x - a.x));
  }
}

}  // namespace

std::vector<Hatch> hatches_of(const std::vector<std::vector<Vec2>>& polygons, const HatchRule& rule, int64_t layer) {
  const Vec2 along = direction_at(rule.angle_degrees + static_cast<double>(layer) * rule.turn_degrees);
  const Vec2 across{-along.y, along.x};
  const auto turned = [&](Vec2 p) { return Vec2{p.x * along.x + p.y * along.y, p.x * across.x + p.y * across.y}; };
  Crossings crossings;
  for (const auto& polygon : polygons)
    for (size_t n = 0; n < polygon.size(); ++n)
      add_edge(turned(polygon[n]), turned(polygon[(n + 1) % polygon.size()]), rule.spacing_mm, crossings);
  std::vector<Hatch> hatches;
  for (auto& [ray, places] : crossings) {
    std::ranges::sort(places);
    const double at = (static_cast<double>(ray) + 0.5) * rule.spacing_mm;
    const auto point = [&](double place) {
      return Vec2{place * along.x + at * across.x, place * along.y + at * across.y};
    };
    std::vector<Hatch> lines;
    for (size_t n = 0; n + 1 < places.size(); n += 2)
      if (places[n] < places[n + 1]) lines.push_back({point(places[n]), point(places[n + 1])});
    if (ray % 2 != 0) {
      std::ranges::reverse(lines);
      for (Hatch& line : lines) std::swap(line.from, line.to);
    }
    hatches.insert(hatches.end(), lines.begin(), lines.end());
  }
  return hatches;
}

}  // namespace ombre::formats
