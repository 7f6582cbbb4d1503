#include "surface/mesh/intersections.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/math/box_tree.h"

namespace ombre::surface {
namespace {

constexpr double nearly_one = 1 - 1e-6;  // magnitude of the cosine from which facets are parallel

// All triangles of a surface.
class Triangles {
 public:
  explicit Triangles(const QuadSurface& surface) : places_(surface.clusters().places()) {
    for (uint32_t quad = 0; quad < surface.quads(); ++quad)
      for (const Triangle& triangle : surface.triangles(quad)) {
        all_.push_back(triangle);
        quads_.push_back(quad);
      }
  }

  uint32_t size() const { return static_cast<uint32_t>(all_.size()); }
  uint32_t quad(uint32_t n) const { return quads_[n]; }
  Box box(uint32_t n) const { return box_of({places_[all_[n][0]], places_[all_[n][1]], places_[all_[n][2]]}); }

  bool cross(uint32_t a, uint32_t b) const {
    if (a > b) std::swap(a, b);
    return pierces(all_[a], all_[b]) || pierces(all_[b], all_[a]) || lie_upon(all_[a], all_[b]);
  }

 private:
  // Returns six times the volume of a tetrahedron.
  double volume(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
    const Vec3 from = places_[a];
    return dot(places_[b] - from, ombre::cross(places_[c] - from, places_[d] - from));
  }

  static bool has(const Triangle& triangle, uint32_t corner) {
    return std::ranges::find(triangle, corner) != triangle.end();
  }

  // True if a side of `a` that shares no vertex with `b` passes through `b`.
  bool pierces(const Triangle& a, const Triangle& b) const {
    for (size_t n = 0; n < 3; ++n) {
      const uint32_t from = a[n], to = a[(n + 1) % 3];
      if (!has(b, from) && !has(b, to) && goes_through(from, to, b)) return true;
    }
    return false;
  }

  // True if two facets with a common side are folded flat onto each other.
  bool lie_upon(const Triangle& a, const Triangle& b) const {
    for (size_t n = 0; n < 3; ++n) {
      const uint32_t from = a[n], to = a[(n + 1) % 3], third = a[(n + 2) % 3];
      if (!has(b, from) || !has(b, to)) continue;
      const auto other = std::ranges::find_if(b, [&](uint32_t c) { return c != from && c != to; });
      if (other == b.end() || *other == third) return true;
      const Vec3 one = beside(from, to, third), two = beside(from, to, *other);
      return dot(one, two) > nearly_one * length(one) * length(two);
    }
    return false;
  }

  // Returns the vector from the line through two corners to a third corner, perpendicular to the line.
  Vec3 beside(uint32_t from, uint32_t to, uint32_t third) const {
    const Vec3 along = places_[to] - places_[from], way = places_[third] - places_[from];
    const double share = dot(way, along) / dot(along, along);
    return way - share * along;
  }

  bool goes_through(uint32_t from, uint32_t to, const std::array<uint32_t, 3>& t) const {
    const double before = volume(from, t[0], t[1], t[2]), behind = volume(to, t[0], t[1], t[2]);
    if (!(before * behind < 0)) return false;
    const double a = volume(from, to, t[0], t[1]), b = volume(from, to, t[1], t[2]), c = volume(from, to, t[2], t[0]);
    return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
  }

  const std::vector<Vec3>& places_;
  std::vector<Triangle> all_;
  std::vector<uint32_t> quads_;
};

// Finds intersecting pairs of triangles of which at least one is fresh.
class PairFinder {
 public:
  PairFinder(const Triangles& triangles, const std::vector<uint32_t>& fresh_quads) : triangles_(triangles) {
    std::vector<Box> boxes;
    auto quad = fresh_quads.begin();
    for (uint32_t n = 0; n < triangles.size(); ++n) {
      while (quad != fresh_quads.end() && *quad < triangles.quad(n)) ++quad;
      const bool is_fresh = quad != fresh_quads.end() && *quad == triangles.quad(n);
      (is_fresh ? fresh_ : others_).push_back(n);
      if (is_fresh) boxes.push_back(triangles.box(n));
    }
    tree_ = BoxTree(boxes);
  }

  QuadPairs find(const Workers& workers) const {
    constexpr size_t piece = 4096;
    const size_t first = (tree_.groups() + piece - 1) / piece, second = (others_.size() + piece - 1) / piece;
    std::vector<QuadPairs> found(first + second);
    workers.in_pieces(found.size(), 1, [&](size_t p, size_t /*end*/) {
      if (p < first)
        search_fresh(p * piece, std::min((p + 1) * piece, tree_.groups()), found[p]);
      else
        search_others((p - first) * piece, std::min((p - first + 1) * piece, others_.size()), found[p]);
    });
    QuadPairs pairs;
    for (const QuadPairs& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    std::ranges::sort(pairs);
    return pairs;
  }

 private:
  void search_fresh(size_t begin, size_t end, QuadPairs& pairs) const {
    for (size_t group = begin; group < end; ++group)
      tree_.each_pair_that_meets(group, [&](uint32_t a, uint32_t b) { check_pair(fresh_[a], fresh_[b], pairs); });
  }

  void search_others(size_t begin, size_t end, QuadPairs& pairs) const {
    for (size_t n = begin; n < end; ++n)
      tree_.each_that_meets(triangles_.box(others_[n]), [&](uint32_t f) { check_pair(others_[n], fresh_[f], pairs); });
  }

  void check_pair(uint32_t a, uint32_t b, QuadPairs& pairs) const {
    if (triangles_.cross(a, b)) pairs.push_back(std::minmax({triangles_.quad(a), triangles_.quad(b)}));
  }

  const Triangles& triangles_;
  std::vector<uint32_t> fresh_, others_;
  BoxTree tree_;
};

}  // namespace

QuadPairs IntersectionFinder::find(const QuadSurface& surface) {
  const std::vector<uint32_t> fresh = clean_.see(surface.shape_hashes());
  if (fresh.empty()) return {};
  const Triangles triangles(surface);
  QuadPairs pairs = PairFinder(triangles, fresh).find(workers_);
  for (const auto& [a, b] : pairs) {
    clean_.forget(a);
    clean_.forget(b);
  }
  return pairs;
}

}  // namespace ombre::surface
