#include "surface/intersections.h"

#include <algorithm>
#include <array>

#include "base/tasks.h"
#include "surface/box_tree.h"

namespace ombre::surface {
namespace {

constexpr double nearly_one = 1 - 1e-6;  // of a cosine

class Facets {
 public:
  Facets(const std::vector<Vec3>& vertices, const std::vector<Facet>& facets) : vertices_(vertices), facets_(facets) {}

  Box box(const Facet& facet) const {
    Box box;
    for (const uint32_t corner : facet.corners) box = hull(box, {vertices_[corner], vertices_[corner]});
    return box;
  }

  bool cross(uint32_t a, uint32_t b) const {
    return pierces(facets_[a], facets_[b]) || pierces(facets_[b], facets_[a]) || lie_upon(facets_[a], facets_[b]);
  }

 private:
  // Six times the volume of a tetrahedron.
  double volume(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
    const Vec3 from = vertices_[a];
    return dot(vertices_[b] - from, ombre::cross(vertices_[c] - from, vertices_[d] - from));
  }

  static bool has(const Facet& facet, uint32_t corner) {
    return std::ranges::find(facet.corners, corner) != facet.corners.end();
  }

  // Whether a side of `a` that has no end in common with `b` goes through it.
  bool pierces(const Facet& a, const Facet& b) const {
    for (size_t n = 0; n < 3; ++n) {
      const uint32_t from = a.corners[n], to = a.corners[(n + 1) % 3];
      if (!has(b, from) && !has(b, to) && goes_through(from, to, b.corners)) return true;
    }
    return false;
  }

  // Whether facets with a common side are folded flat upon each other.
  bool lie_upon(const Facet& a, const Facet& b) const {
    for (size_t n = 0; n < 3; ++n) {
      const uint32_t from = a.corners[n], to = a.corners[(n + 1) % 3], third = a.corners[(n + 2) % 3];
      if (!has(b, from) || !has(b, to)) continue;
      const auto other = std::ranges::find_if(b.corners, [&](uint32_t c) { return c != from && c != to; });
      if (other == b.corners.end() || *other == third) return true;
      const Vec3 one = beside(from, to, third), two = beside(from, to, *other);
      return dot(one, two) > nearly_one * length(one) * length(two);
    }
    return false;
  }

  // From the line through two corners to a third, at right angles.
  Vec3 beside(uint32_t from, uint32_t to, uint32_t third) const {
    const Vec3 along = vertices_[to] - vertices_[from], way = vertices_[third] - vertices_[from];
    const double share = dot(way, along) / dot(along, along);
    return way - share * along;
  }

  bool goes_through(uint32_t from, uint32_t to, const std::array<uint32_t, 3>& t) const {
    const double before = volume(from, t[0], t[1], t[2]), behind = volume(to, t[0], t[1], t[2]);
    if (!(before * behind < 0)) return false;
    const double a = volume(from, to, t[0], t[1]), b = volume(from, to, t[1], t[2]), c = volume(from, to, t[2], t[0]);
    return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
  }

  const std::vector<Vec3>& vertices_;
  const std::vector<Facet>& facets_;
};

}  // namespace

std::vector<std::pair<uint32_t, uint32_t>> find_intersections(const std::vector<Vec3>& vertices,
                                                              const std::vector<Facet>& facets, int threads) {
  if (facets.empty()) return {};
  const Facets all(vertices, facets);
  std::vector<Box> boxes;
  for (const Facet& facet : facets) boxes.push_back(all.box(facet));
  const BoxTree tree(std::move(boxes));

  constexpr size_t piece = 4096;
  const size_t pieces = (facets.size() + piece - 1) / piece;
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> found(pieces);
  run_parallel(pieces, threads, [&](size_t p) {
    const auto end = static_cast<uint32_t>(std::min((p + 1) * piece, facets.size()));
    for (auto facet = static_cast<uint32_t>(p * piece); facet < end; ++facet)
      tree.each_that_meets(tree.box(facet), [&](uint32_t other) {
        if (other > facet && all.cross(facet, other)) found[p].emplace_back(facet, other);
      });
  });
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace ombre::surface
