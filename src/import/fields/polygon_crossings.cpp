#include "import/fields/polygon_crossings.h"

#include <algorithm>

namespace ombre::importing {
namespace {

constexpr uint32_t most_bins = 1 << 16;

}  // namespace

PolygonCrossings::PolygonCrossings(const Polygons& polygons, Vec2 step) : step_(step) {
  add(polygons.solid, false);
  add(polygons.holes, true);
  std::vector<DyadicBins::Rectangle> lines;
  for (size_t n = 0; n < edges_.size(); ++n) {
    const auto [lo, hi] = std::minmax(edges_[n].placed.from.y, edges_[n].placed.to.y);
    lines.push_back({{lo, 0}, {hi, 0}, static_cast<uint32_t>(n)});
  }
  bins_.emplace(lines,
                std::array<uint32_t, 2>{std::clamp<uint32_t>(static_cast<uint32_t>(lines.size()), 1, most_bins), 1});
}

void PolygonCrossings::add(const std::vector<Ring>& rings, bool are_holes) {
  for (const Ring& ring : rings) {
    for (size_t n = 0; n < ring.size(); ++n) {
      const Vec2 from = ring[n], to = ring[(n + 1) % ring.size()];
      edges_.push_back({{{place_of(from), line_of(from)}, {place_of(to), line_of(to)}}, are_holes});
    }
  }
}

PolygonWinding PolygonCrossings::winding_at(Vec2 p) const {
  const double place = place_of(p);
  PolygonWinding found;
  at(line_of(p), [&](double crossed, int change, bool is_hole) {
    if (crossed <= place) (is_hole ? found.holes : found.solid) += change;
  });
  return found;
}

}  // namespace ombre::importing
