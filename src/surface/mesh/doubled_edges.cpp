#include "surface/mesh/doubled_edges.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace ombre::surface {
namespace {

// One side of a facet, from corner `side` to the next corner.
struct FacetSide {
  uint32_t low, high;  // vertices at its ends
  Label less, greater;
  uint32_t facet;
  uint8_t side;

  auto key() const { return std::tie(low, high, less, greater); }
};

std::vector<FacetSide> sides_of(const RegionSurface& surface) {
  std::vector<FacetSide> sides;
  sides.reserve(3 * surface.facets.size());
  for (uint32_t n = 0; n < surface.facets.size(); ++n) {
    const Facet& f = surface.facets[n];
    for (uint8_t side = 0; side < 3; ++side) {
      const uint32_t a = f.corners[side], b = f.corners[(side + 1U) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), std::min(f.back, f.front), std::max(f.back, f.front), n, side});
    }
  }
  std::ranges::sort(sides, {}, [](const FacetSide& s) { return std::tuple(s.key(), s.facet, s.side); });
  return sides;
}

// A facet with its corners in ascending order.
struct SortedFacet {
  std::array<uint32_t, 3> corners{};
  Label less = 0, greater = 0;
  bool is_forward = true;  // true if the corners are counter-clockwise as seen from the lesser region
  uint32_t facet = 0;

  auto key() const { return std::tie(corners, less, greater); }
};

SortedFacet sorted(const Facet& facet, uint32_t number) {
  SortedFacet made{facet.corners, std::min(facet.back, facet.front), std::max(facet.back, facet.front), true, number};
  std::rotate(made.corners.begin(), std::ranges::min_element(made.corners), made.corners.end());
  const bool ascends = made.corners[1] < made.corners[2];
  if (!ascends) std::swap(made.corners[1], made.corners[2]);
  made.is_forward = ascends == (facet.back > facet.front);
  return made;
}

// Removes pairs of facets that have the same corners and face opposite ways: they enclose nothing, and no vertex on an
// edge could separate them.
void leave_out_facing_pairs(RegionSurface& surface) {
  std::vector<SortedFacet> all;
  all.reserve(surface.facets.size());
  for (uint32_t n = 0; n < surface.facets.size(); ++n) all.push_back(sorted(surface.facets[n], n));
  std::ranges::sort(all, {}, [](const SortedFacet& f) { return std::tuple(f.key(), f.facet); });
  std::vector<bool> is_out(surface.facets.size());
  for (size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    std::array<std::vector<uint32_t>, 2> ways;
    for (end = begin; end < all.size() && all[end].key() == all[begin].key(); ++end)
      ways[all[end].is_forward].push_back(all[end].facet);
    for (size_t n = 0; n < std::min(ways[0].size(), ways[1].size()); ++n)
      is_out[ways[0][n]] = is_out[ways[1][n]] = true;
  }
  size_t kept = 0;
  for (size_t n = 0; n < surface.facets.size(); ++n)
    if (!is_out[n]) surface.facets[kept++] = surface.facets[n];
  surface.facets.resize(kept);
}

class Cutter {
 public:
  Cutter(RegionSurface& surface, size_t vertices) : surface_(surface), vertices_(vertices), sides_(sides_of(surface)) {}

  // Cuts doubled edges, each facet at most once. Returns false if no edge is doubled.
  bool cut() {
    is_cut_.assign(surface_.facets.size(), false);
    bool any = false;
    for (size_t begin = 0; begin < sides_.size();) {
      size_t end = begin + 1;
      bool is_doubled = false;
      while (end < sides_.size() && sides_[end].low == sides_[begin].low && sides_[end].high == sides_[begin].high) {
        is_doubled |= end >= begin + 2 && sides_[end].key() == sides_[end - 2].key();
        ++end;
      }
      // The halves of a cut edge stay doubled, so they are not cut again.
      if (is_doubled && sides_[begin].high < vertices_) {
        cut_edge(begin, end);
        any = true;
      }
      begin = end;
    }
    return any;
  }

 private:
  void cut_edge(size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n)
      if (is_cut_[sides_[n].facet]) return;
    std::vector<size_t> forward, backward;
    for (size_t n = begin; n < end; ++n) (is_forward(sides_[n]) ? forward : backward).push_back(n);
    const Vec3 at = 0.5 * (surface_.vertices[sides_[begin].low] + surface_.vertices[sides_[begin].high]);
    const bool is_of_two = sides_[begin].key() == sides_[end - 1].key() && forward.size() == backward.size();
    // Between two regions, each pair of facets gets its own vertex; where more regions meet, all facets share one.
    uint32_t middle = add_vertex(at);
    for (size_t n = 0; n < std::max(forward.size(), backward.size()); ++n) {
      if (n > 0 && is_of_two) middle = add_vertex(at);
      if (n < forward.size()) cut_facet(sides_[forward[n]], middle);
      if (n < backward.size()) cut_facet(sides_[backward[n]], middle);
    }
  }

  // True if the facet, seen from the lesser region, runs from the lower to the higher vertex.
  bool is_forward(const FacetSide& side) const {
    const Facet& facet = surface_.facets[side.facet];
    return (facet.corners[side.side] == side.low) == (facet.back < facet.front);
  }

  uint32_t add_vertex(Vec3 at) {
    surface_.vertices.push_back(at);
    return static_cast<uint32_t>(surface_.vertices.size() - 1);
  }

  void cut_facet(const FacetSide& side, uint32_t middle) {
    Facet& facet = surface_.facets[side.facet];
    Facet other = facet;
    facet.corners[(side.side + 1U) % 3] = middle;
    other.corners[side.side] = middle;
    is_cut_[side.facet] = true;
    surface_.facets.push_back(other);
  }

  RegionSurface& surface_;
  size_t vertices_;  // number of vertices before the first cut
  std::vector<FacetSide> sides_;
  std::vector<bool> is_cut_;
};

}  // namespace

void cut_doubled_edges(RegionSurface& surface) {
  leave_out_facing_pairs(surface);
  const size_t vertices = surface.vertices.size();
  while (Cutter(surface, vertices).cut()) {
  }
}

}  // namespace ombre::surface
