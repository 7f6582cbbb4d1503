// Makes surface meshes of triangles, even if more than two of them share an edge.
#include "solids/cgal/cgal_boxes.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "solids/cgal/cgal_body.h"

namespace ombre::solids {
namespace {

using Point = Exact::Point_3;
using Polygons = std::vector<std::vector<std::size_t>>;

struct Use {
  size_t triangle = 0, apex = 0;  // `apex` is the number of the opposite point
};

// Triangles at an edge: those from its lower point to its higher one, and those in reverse.
struct EdgeUses {
  std::vector<Use> forward, backward;
};

// Joins corners of triangles that share an edge of the same sector into one vertex.
class Splitter {
 public:
  Splitter(const std::vector<Point>& points, const Polygons& triangles) : points_(points), triangles_(triangles) {
    first_.resize(3 * triangles.size());
    std::iota(first_.begin(), first_.end(), size_t{0});
    for (size_t t = 0; t < triangles.size(); ++t)
      for (size_t n = 0; n < 3; ++n) {
        const size_t a = triangles[t][n], b = triangles[t][(n + 1) % 3], apex = triangles[t][(n + 2) % 3];
        auto& [forward, backward] = edges_[{std::min(a, b), std::max(a, b)}];
        (a < b ? forward : backward).push_back({t, apex});
      }
  }

  // Joins all pairs. Returns false if an edge is not traversed equally often in both directions.
  bool join() {
    for (auto& [edge, uses] : edges_) {
      if (uses.forward.size() != uses.backward.size()) return false;
      for (const Use& use : uses.forward) {
        const auto partner = partner_of(edge.first, edge.second, use, uses.backward);
        join(use.triangle, partner->triangle, edge.first);
        join(use.triangle, partner->triangle, edge.second);
        if (uses.forward.size() > 1) pairs_.push_back({edge, use.triangle, partner->triangle});
        uses.backward.erase(partner);
      }
    }
    return true;
  }

  void rename(std::vector<Point>& points, Polygons& triangles) {
    std::map<size_t, size_t> numbers;
    std::vector<Point> all;
    for (size_t t = 0; t < triangles.size(); ++t)
      for (size_t n = 0; n < 3; ++n) {
        const auto [place, is_new] = numbers.try_emplace(first(3 * t + n), all.size());
        if (is_new) all.push_back(points_[triangles_[t][n]]);
        triangles[t][n] = place->second;
      }
    points = std::move(all);
    cut_shared_edges(numbers, points, triangles);
  }

 private:
  using Edge = std::pair<size_t, size_t>;

  // A pair of triangles of the same sector at an edge that other triangles share.
  struct Pair {
    Edge edge;
    size_t forward = 0, backward = 0;
  };

  // Sheets that share an edge and are joined at both of its ends would also share the edge of the mesh. So each pair
  // gets its own vertex in the middle of the edge.
  void cut_shared_edges(const std::map<size_t, size_t>& numbers, std::vector<Point>& points, Polygons& triangles) {
    std::map<Edge, int> users;
    for (const auto& triangle : triangles)
      for (size_t n = 0; n < 3; ++n) ++users[{triangle[n], triangle[(n + 1) % 3]}];
    std::multimap<size_t, size_t> pieces;  // pieces of each cut triangle
    const auto cut = [&](size_t triangle, Edge edge, size_t middle) {
      const auto has_edge = [&](size_t t) {
        for (size_t n = 0; n < 3; ++n)
          if (triangles[t][n] == edge.first && triangles[t][(n + 1) % 3] == edge.second) return true;
        return false;
      };
      size_t piece = triangle;
      for (auto [at, end] = pieces.equal_range(triangle); at != end && !has_edge(piece); ++at) piece = at->second;
      std::vector<size_t> rest = triangles[piece];
      std::replace(triangles[piece].begin(), triangles[piece].end(), edge.second, middle);
      std::replace(rest.begin(), rest.end(), edge.first, middle);
      pieces.emplace(triangle, triangles.size());
      triangles.push_back(std::move(rest));
    };
    for (const Pair& pair : pairs_) {
      const auto number = [&](size_t point) { return numbers.at(first(corner(pair.forward, point))); };
      const Edge edge{number(pair.edge.first), number(pair.edge.second)};
      if (users[edge] < 2) continue;
      const size_t middle = points.size();
      points.push_back(CGAL::midpoint(points_[pair.edge.first], points_[pair.edge.second]));
      cut(pair.forward, edge, middle);
      cut(pair.backward, {edge.second, edge.first}, middle);
    }
  }

  // Returns the triangle that bounds the same sector. Turning from a triangle that runs forward along the edge leads
  // outside, so its sector ends at the last of the others.
  std::vector<Use>::iterator partner_of(size_t a, size_t b, const Use& use, std::vector<Use>& others) const {
    const auto turn = [&](size_t apex) {
      return part_of_turn(points_[a], points_[b], points_[use.apex], points_[apex]);
    };
    return std::max_element(others.begin(), others.end(), [&](const Use& x, const Use& y) {
      const int of_x = turn(x.apex), of_y = turn(y.apex);
      if (of_x != of_y) return of_x < of_y;
      return part_of_turn(points_[a], points_[b], points_[x.apex], points_[y.apex]) == 1;
    });
  }

  size_t corner(size_t triangle, size_t point) const {
    const auto& corners = triangles_[triangle];
    return 3 * triangle + (corners[0] == point ? 0 : corners[1] == point ? 1 : 2);
  }
  size_t first(size_t n) {
    while (first_[n] != n) n = first_[n] = first_[first_[n]];
    return n;
  }
  void join(size_t triangle, size_t other, size_t point) {
    const size_t a = first(corner(triangle, point)), b = first(corner(other, point));
    first_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<Pair> pairs_;
  const std::vector<Point> points_;
  const Polygons triangles_;
  std::map<std::pair<size_t, size_t>, EdgeUses> edges_;
  std::vector<size_t> first_;  // union-find parents of corners
};

}  // namespace

ExactMesh mesh_of_soup(std::vector<Point> points, Polygons triangles) {
  namespace processing = CGAL::Polygon_mesh_processing;
  if (!processing::is_polygon_soup_a_polygon_mesh(triangles)) {
    Splitter splitter(points, triangles);
    if (splitter.join())
      splitter.rename(points, triangles);
    else
      processing::orient_polygon_soup(points, triangles);
  }
  ExactMesh mesh;
  processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  return mesh;
}

}  // namespace ombre::solids
