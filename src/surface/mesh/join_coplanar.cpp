#include "surface/mesh/join_coplanar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace ombre::surface {
namespace {

// least cosine between the normals of a facet before and after a collapse in its plane
constexpr double about_parallel = 0.9;
// least height of a facet, in multiples of the allowed distance; lower facets do not define a plane
constexpr double least_heights = 10;
constexpr size_t corner_lines = 3;  // a vertex where at least this many lines meet stays

// A possible edge collapse, which moves a vertex onto its neighbour `to`.
struct Collapse {
  uint32_t to = 0;
  double off_mm = 0;        // distance of the vertex from the planes of the remaining facets
  double least_height = 0;  // least height of the remaining facets, mm
};

class CoplanarJoiner {
 public:
  CoplanarJoiner(RegionSurface& surface, double most_mm, const Workers& workers)
      : surface_(surface),
        most_mm_(most_mm),
        workers_(workers),
        facets_of_(surface.vertices.size()),
        off_mm_(surface.vertices.size()),
        is_open_(surface.vertices.size(), true),
        is_gone_(surface.facets.size()) {
    for (uint32_t n = 0; n < surface_.facets.size(); ++n)
      for (const uint32_t corner : surface_.facets[n].corners) facets_of_[corner].push_back(n);
  }

  void join() {
    for (bool any = true; any;) {
      any = false;
      for (uint32_t vertex = 0; vertex < facets_of_.size(); ++vertex) {
        workers_.check_stop_at(vertex);
        if (!is_open_[vertex]) continue;
        is_open_[vertex] = false;
        const std::optional<Collapse> best = best_collapse(vertex);
        if (best) collapse(vertex, *best);
        any |= best.has_value();
      }
    }
    leave_out_gone();
  }

 private:
  Vec3 at(uint32_t vertex) const { return surface_.vertices[vertex]; }
  const std::array<uint32_t, 3>& corners(uint32_t facet) const { return surface_.facets[facet].corners; }
  bool has_corner(uint32_t facet, uint32_t vertex) const {
    return std::ranges::find(corners(facet), vertex) != corners(facet).end();
  }

  // Returns the normal of a triangle, with a length of twice its area.
  static Vec3 normal(const std::array<Vec3, 3>& c) { return cross(c[1] - c[0], c[2] - c[0]); }

  // Returns the neighbours in ascending order; a neighbour occurs once for each facet shared with the vertex.
  std::vector<uint32_t> neighbours(uint32_t vertex) const {
    std::vector<uint32_t> found;
    for (const uint32_t facet : facets_of_[vertex])
      for (const uint32_t corner : corners(facet))
        if (corner != vertex) found.push_back(corner);
    std::ranges::sort(found);
    return found;
  }

  std::optional<Collapse> best_collapse(uint32_t vertex) const {
    if (facets_of_[vertex].empty()) return std::nullopt;
    const std::vector<uint32_t> around = neighbours(vertex);
    const auto facets_between = [&](uint32_t other) { return std::ranges::count(around, other); };
    std::vector<uint32_t> others = around;
    others.erase(std::unique(others.begin(), others.end()), others.end());
    const auto lines =
        static_cast<size_t>(std::ranges::count_if(others, [&](uint32_t o) { return facets_between(o) != 2; }));
    if (lines >= corner_lines) return std::nullopt;
    std::optional<Collapse> best;
    for (const uint32_t to : others) {
      if (lines > 0 && facets_between(to) == 2) continue;
      const std::optional<Collapse> found = measured(vertex, to);
      if (found && (!best || found->least_height > best->least_height) && keeps_topology(vertex, to, others))
        best = found;
    }
    return best;
  }

  // Measures a collapse; null if a facet would leave its plane, fold or vanish.
  std::optional<Collapse> measured(uint32_t vertex, uint32_t to) const {
    Collapse made{to, 0, 1e300};
    for (const uint32_t facet : facets_of_[vertex]) {
      if (has_corner(facet, to)) continue;
      std::array<Vec3, 3> before, after;
      for (size_t n = 0; n < 3; ++n) {
        const uint32_t corner = corners(facet)[n];
        before[n] = at(corner);
        after[n] = at(corner == vertex ? to : corner);
      }
      const Vec3 was = normal(before), is = normal(after);
      const double size = length(is);
      if (std::abs(dot(is, at(vertex) - at(to))) > most_mm_ * size) return std::nullopt;
      if (size == 0 || dot(was, is) < about_parallel * length(was) * size) return std::nullopt;
      made.off_mm = std::max(made.off_mm, std::abs(dot(is, at(vertex) - at(to))) / size);
      made.least_height = std::min(made.least_height, size / longest_side(after));
    }
    const bool is_exact = off_mm_[vertex] + made.off_mm <= most_mm_ && made.least_height >= least_heights * most_mm_;
    return is_exact ? std::optional(made) : std::nullopt;
  }

  static double longest_side(const std::array<Vec3, 3>& c) {
    return std::max({length(c[1] - c[0]), length(c[2] - c[1]), length(c[0] - c[2])});
  }

  // Checks the link condition (Dey et al. 1999): every common neighbour of both vertices must be opposite to the edge
  // between them.
  bool keeps_topology(uint32_t vertex, uint32_t to, const std::vector<uint32_t>& others) const {
    std::vector<uint32_t> beside;
    for (const uint32_t facet : facets_of_[vertex])
      if (has_corner(facet, to))
        for (const uint32_t corner : corners(facet))
          if (corner != vertex && corner != to) beside.push_back(corner);
    for (const uint32_t facet : facets_of_[to]) {
      if (has_corner(facet, vertex)) continue;
      for (const uint32_t corner : corners(facet))
        if (std::ranges::binary_search(others, corner) && corner != to &&
            std::ranges::find(beside, corner) == beside.end())
          return false;
      if (is_opposite(vertex, facet, to)) return false;
    }
    return true;
  }

  // True if the side of `facet` opposite to `to` also belongs to another facet around the vertex; the collapse would
  // merge both facets.
  bool is_opposite(uint32_t vertex, uint32_t facet, uint32_t to) const {
    return std::ranges::any_of(facets_of_[vertex], [&](uint32_t other) {
      return !has_corner(other, to) && std::ranges::all_of(corners(facet), [&](uint32_t corner) {
        return corner == to || has_corner(other, corner);
      });
    });
  }

  void collapse(uint32_t vertex, const Collapse& made) {
    for (const uint32_t facet : facets_of_[vertex]) {
      for (const uint32_t corner : corners(facet)) is_open_[corner] = true;
      if (has_corner(facet, made.to)) {
        is_gone_[facet] = true;
        for (const uint32_t corner : corners(facet))
          if (corner != vertex) std::erase(facets_of_[corner], facet);
        continue;
      }
      std::ranges::replace(surface_.facets[facet].corners, vertex, made.to);
      facets_of_[made.to].push_back(facet);
    }
    facets_of_[vertex].clear();
    off_mm_[made.to] = std::max(off_mm_[made.to], off_mm_[vertex] + made.off_mm);
  }

  void leave_out_gone() {
    size_t kept = 0;
    for (size_t n = 0; n < surface_.facets.size(); ++n)
      if (!is_gone_[n]) surface_.facets[kept++] = surface_.facets[n];
    surface_.facets.resize(kept);
    std::vector<uint32_t> numbers(surface_.vertices.size());
    uint32_t count = 0;
    for (uint32_t vertex = 0; vertex < numbers.size(); ++vertex) {
      if (facets_of_[vertex].empty()) continue;
      surface_.vertices[count] = surface_.vertices[vertex];
      numbers[vertex] = count++;
    }
    surface_.vertices.resize(count);
    for (Facet& facet : surface_.facets)
      for (uint32_t& corner : facet.corners) corner = numbers[corner];
  }

  RegionSurface& surface_;
  double most_mm_;
  const Workers& workers_;
  std::vector<std::vector<uint32_t>> facets_of_;  // by vertex
  std::vector<double> off_mm_;  // by vertex: greatest distance from the planes of all that collapsed into it
  std::vector<bool> is_open_;   // by vertex: its surroundings changed, so it has to be examined
  std::vector<bool> is_gone_;   // by facet
};

}  // namespace

void join_coplanar(RegionSurface& surface, double most_mm, const Workers& workers) {
  CoplanarJoiner(surface, most_mm, workers).join();
}

}  // namespace ombre::surface
