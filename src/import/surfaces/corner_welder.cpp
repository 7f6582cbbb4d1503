// Joins corners of triangles that differ by rounding.
#include "import/surfaces/corner_welder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/math/box.h"
#include "import/surfaces/mesh_edges.h"

namespace ombre::importing {
namespace {

// Least and greatest tolerances, relative to the largest coordinate and to the size; the least is the rounding of
// doubles.
constexpr double least_tolerance = 4 * std::numeric_limits<double>::epsilon(), most_tolerance = 1e-5;
constexpr double tolerance_step = 8;
// Length relative to the largest coordinate up to which an edge may be caused by rounding to floats.
constexpr double rounding_of_floats = 2 * static_cast<double>(std::numeric_limits<float>::epsilon());

// An edge that its triangles do not traverse equally often in both directions.
struct OpenEdge {
  uint32_t from = 0, to = 0;
  int64_t excess = 0;  // triangles that run from `from` to `to`, less those that run back
};

// Gives points near each other one number, that of the first of them.
class NearPoints {
 public:
  NearPoints(const std::vector<Vec3>& places, Vec3 origin, double tolerance)
      : places_(places), origin_(origin), tolerance_(tolerance), cell_(cells_per_tolerance * tolerance) {}

  // Adds a place and joins it with those added before that are near.
  void add(uint32_t place) {
    parent_.emplace(place, place);
    const Vec3 p = places_[place] - origin_;
    const Vec3 reach{tolerance_, tolerance_, tolerance_};
    const Cell lo = cell_of(p - reach), hi = cell_of(p + reach), own = cell_of(p);
    bool is_known = false;
    for (int64_t x = lo.x; x <= hi.x; ++x)
      for (int64_t y = lo.y; y <= hi.y; ++y)
        for (int64_t z = lo.z; z <= hi.z; ++z) {
          const Cell cell{x, y, z};
          if (join_with(cell, place) && cell == own) is_known = true;
        }
    if (!is_known) cells_[own].push_back(place);
  }

  uint32_t first_of(uint32_t place) const {
    for (;;) {
      const auto found = parent_.find(place);
      if (found == parent_.end() || found->second == place) return place;
      place = found->second;
    }
  }

 private:
  // Cells are so wide that most points need to look at only one. A cell does not list points near to others in it.
  static constexpr double cells_per_tolerance = 8;

  struct Cell {
    int64_t x = 0, y = 0, z = 0;
    bool operator==(const Cell&) const = default;
  };
  struct CellHash {
    size_t operator()(const Cell& cell) const {
      uint64_t h = 0;
      for (const int64_t part : {cell.x, cell.y, cell.z}) {
        h = (h ^ static_cast<uint64_t>(part)) * 0x9E3779B97F4A7C15u;
        h ^= h >> 32;
      }
      return h;
    }
  };

  Cell cell_of(Vec3 p) const {
    const auto part = [&](double x) { return static_cast<int64_t>(std::floor(x / cell_)); };
    return {part(p.x), part(p.y), part(p.z)};
  }

  bool join_with(const Cell& cell, uint32_t place) {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return false;
    bool is_near = false;
    for (const uint32_t other : found->second) {
      if (length(places_[other] - places_[place]) > tolerance_) continue;
      join(other, place);
      is_near = true;
    }
    return is_near;
  }

  void join(uint32_t a, uint32_t b) {
    a = first_of(a);
    b = first_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  const std::vector<Vec3>& places_;
  Vec3 origin_;
  double tolerance_, cell_;
  std::unordered_map<Cell, std::vector<uint32_t>, CellHash> cells_;
  std::unordered_map<uint32_t, uint32_t> parent_;
};

class CornerWelder {
 public:
  CornerWelder(formats::Mesh& mesh, bool any_direction)
      : mesh_(mesh), any_direction_(any_direction), placed_(placed_triangles(mesh)) {}

  std::optional<WeldedCorners> weld() {
    find_open_edges();
    if (open_.empty()) return std::nullopt;
    Box box;
    for (const auto& t : placed_.triangles)
      for (const uint32_t corner : t) box = hull(box, Box{placed_.places[corner], placed_.places[corner]});
    const Vec3 far = max(abs_of(box.lo), abs_of(box.hi));
    largest_ = std::max({far.x, far.y, far.z});
    const Vec3 size = box.size();
    const double most = most_tolerance * std::max({size.x, size.y, size.z});
    for (double tolerance = std::min(most, least_tolerance * largest_); tolerance > 0;
         tolerance = std::min(most, tolerance_step * tolerance)) {
      NearPoints near(placed_.places, box.lo, tolerance);
      for (const uint32_t corner : corners_) near.add(corner);
      if (collapses(near)) return std::nullopt;
      if (closes(near)) return apply(near);
      if (tolerance == most) break;
    }
    return std::nullopt;
  }

 private:
  static Vec3 abs_of(Vec3 p) { return {std::abs(p.x), std::abs(p.y), std::abs(p.z)}; }
  static Vec3 max(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

  void find_open_edges() {
    const std::vector<FacetEdge> edges = sorted_edges(placed_.triangles);
    std::vector<bool> is_open(placed_.places.size());
    for_each_edge(edges, [&](std::span<const FacetEdge> edge) {
      const int64_t excess = any_direction_ ? static_cast<int64_t>(edge.size() % 2) : balance(edge);
      if (excess == 0) return;
      const uint32_t a = edge[0].lesser(), b = edge[0].greater();
      open_.push_back({a, b, excess});
      is_open[a] = is_open[b] = true;
    });
    for (uint32_t n = 0; n < is_open.size(); ++n)
      if (is_open[n]) corners_.push_back(n);
    for_each_edge(edges, [&](std::span<const FacetEdge> edge) {
      if (is_open[edge[0].from] && is_open[edge[0].to]) between_.push_back({edge[0].from, edge[0].to, 0});
    });
  }

  // Returns true if an edge longer than rounding would collapse.
  bool collapses(const NearPoints& near) const {
    return std::any_of(between_.begin(), between_.end(), [&](const OpenEdge& edge) {
      return near.first_of(edge.from) == near.first_of(edge.to) &&
             length(placed_.places[edge.from] - placed_.places[edge.to]) > rounding_of_floats * largest_;
    });
  }

  bool closes(const NearPoints& near) const {
    std::vector<OpenEdge> edges;
    for (const OpenEdge& edge : open_) {
      const uint32_t a = near.first_of(edge.from), b = near.first_of(edge.to);
      if (a < b) edges.push_back({a, b, edge.excess});
      if (a > b) edges.push_back({b, a, -edge.excess});
    }
    std::sort(edges.begin(), edges.end(),
              [](const OpenEdge& x, const OpenEdge& y) { return x.from != y.from ? x.from < y.from : x.to < y.to; });
    for (size_t i = 0; i < edges.size();) {
      const OpenEdge first = edges[i];
      int64_t sum = 0;
      for (; i < edges.size() && edges[i].from == first.from && edges[i].to == first.to; ++i) sum += edges[i].excess;
      if (any_direction_ ? sum % 2 != 0 : sum != 0) return false;
    }
    return true;
  }

  WeldedCorners apply(const NearPoints& near) {
    WeldedCorners welded;
    std::vector<bool> is_first(placed_.places.size());
    for (const uint32_t corner : corners_) {
      const uint32_t first = near.first_of(corner);
      if (first == corner) continue;
      welded.corners += is_first[first] ? 1 : 2;
      is_first[first] = true;
      welded.farthest_mm = std::max(welded.farthest_mm, length(placed_.places[corner] - placed_.places[first]));
    }
    for (size_t n = 0; n < mesh_.vertices.size(); ++n) {
      const uint32_t place = placed_.place_of[n], first = near.first_of(place);
      if (first != place) mesh_.vertices[n] = placed_.places[first];
    }
    return welded;
  }

  formats::Mesh& mesh_;
  bool any_direction_;
  PlacedTriangles placed_;
  std::vector<OpenEdge> open_, between_;  // between_: all edges whose corners both belong to open edges
  std::vector<uint32_t> corners_;         // places at open edges, in ascending order
  double largest_ = 0;                    // largest coordinate
};

}  // namespace

std::optional<WeldedCorners> weld_corners(formats::Mesh& mesh, bool any_direction) {
  return CornerWelder(mesh, any_direction).weld();
}

}  // namespace ombre::importing
