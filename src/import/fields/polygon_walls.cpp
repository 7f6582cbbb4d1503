#include "import/fields/polygon_walls.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ombre::importing {
namespace {

// Lengths relative to the size of all polygons: lines nearer than the first coincide; the second is the distance beside
// an edge at which inside is tested.
constexpr double nearest_lines = 1e-12, beside = 1e-9;
// Rounding error of coordinates, relative to their distance from the origin.
constexpr double rounding = 1e-15;

struct Edge {
  Vec2 from, to;
  double lo_x() const { return std::min(from.x, to.x); }
  double hi_x() const { return std::max(from.x, to.x); }
  double lo_y() const { return std::min(from.y, to.y); }
  double hi_y() const { return std::max(from.y, to.y); }
  Vec2 at(double t) const { return {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)}; }
};

std::vector<Edge> edges_of(const Ring& ring) {
  std::vector<Edge> edges;
  for (size_t n = 0; n < ring.size(); ++n) edges.push_back({ring[n], ring[(n + 1) % ring.size()]});
  return edges;
}

struct Extent {
  double size = 0, farthest = 0;  // size of the box around all edges; greatest distance from the origin

  explicit Extent(const std::vector<Edge>& edges) {
    Box box;
    for (const Edge& e : edges) box = hull(box, Box{{e.lo_x(), e.lo_y(), 0}, {e.hi_x(), e.hi_y(), 0}});
    size = length(box.size());
    farthest = box.is_empty() ? 0 : std::max(length(box.lo), length(box.hi));
  }
};

// Exchanges x and y if that makes edges shorter along x, so that fewer overlap during the sweep.
std::vector<Edge> turned_for_sweep(std::vector<Edge> edges) {
  double along_x = 0, along_y = 0;
  for (const Edge& e : edges) {
    along_x += e.hi_x() - e.lo_x();
    along_y += e.hi_y() - e.lo_y();
  }
  if (along_x <= along_y) return edges;
  for (Edge& e : edges) e = {{e.from.y, e.from.x}, {e.to.y, e.to.x}};
  return edges;
}

// Calls visit(a, b) once for each pair of edges whose boxes meet, and stops when it returns true.
template <class Visit>
void find_neighbours(const std::vector<Edge>& all, double room, const Visit& visit) {
  const std::vector<Edge> edges = turned_for_sweep(all);
  std::vector<size_t> order(edges.size()), open;
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return edges[a].lo_x() < edges[b].lo_x(); });
  for (const size_t a : order) {
    const Edge& edge = edges[a];
    std::erase_if(open, [&](size_t b) { return edges[b].hi_x() + room < edge.lo_x(); });
    for (const size_t b : open)
      if (edges[b].lo_y() <= edge.hi_y() + room && edge.lo_y() <= edges[b].hi_y() + room && visit(b, a)) return;
    open.push_back(a);
  }
}

// Adds a place at which an edge is to be cut, as a share of its length.
void add_cut(std::vector<double>& cuts, double t) {
  if (t > 0 && t < 1) cuts.push_back(t);
}

double share_along(const Edge& edge, Vec2 p) {
  const Vec2 way = edge.to - edge.from;
  return dot(way, p - edge.from) / dot(way, way);
}

void cut_each_other(const Edge& a, std::vector<double>& cuts_a, const Edge& b, std::vector<double>& cuts_b,
                    double room) {
  const Vec2 way_a = a.to - a.from, way_b = b.to - b.from;
  const double length_a = std::sqrt(dot(way_a, way_a)), length_b = std::sqrt(dot(way_b, way_b));
  if (length_a <= room || length_b <= room) return;
  const double area = cross(way_a, way_b);
  if (std::abs(area) > nearest_lines * length_a * length_b) {
    const double t = cross(b.from - a.from, way_b) / area, u = cross(b.from - a.from, way_a) / area;
    const double room_a = room / length_a, room_b = room / length_b;
    if (t < -room_a || t > 1 + room_a || u < -room_b || u > 1 + room_b) return;
    add_cut(cuts_a, t);
    add_cut(cuts_b, u);
    return;
  }
  if (std::abs(cross(way_a, b.from - a.from)) > room * length_a) return;  // parallel but separate
  for (const Vec2 p : {b.from, b.to}) add_cut(cuts_a, share_along(a, p));
  for (const Vec2 p : {a.from, a.to}) add_cut(cuts_b, share_along(b, p));
}

// Appends the pieces of an edge that are walls; consecutive pieces are joined.
void append_walls(const Edge& edge, std::vector<double>& cuts, double step, const PolygonCrossings& crossings,
                  std::vector<LineSegment>& walls) {
  const Vec2 way = edge.to - edge.from;
  const double length = std::sqrt(dot(way, way));
  if (!(length > 0)) return;
  const Vec2 aside{-way.y / length * step, way.x / length * step};
  cuts.push_back(0);
  cuts.push_back(1);
  std::sort(cuts.begin(), cuts.end());
  bool goes_on = false;
  for (size_t n = 0; n + 1 < cuts.size(); ++n) {
    if (cuts[n] == cuts[n + 1]) continue;
    const Vec2 middle = edge.at(0.5 * (cuts[n] + cuts[n + 1])), end = edge.at(cuts[n + 1]), begin = edge.at(cuts[n]);
    const bool left = crossings.winding_at({middle.x + aside.x, middle.y + aside.y}).is_inside();
    const bool right = crossings.winding_at(middle - aside).is_inside();
    const bool was_wall = goes_on;
    goes_on = left != right;
    if (!goes_on) continue;
    if (was_wall)
      walls.back().to = {end.x, end.y, 0};
    else
      walls.push_back({{begin.x, begin.y, 0}, {end.x, end.y, 0}});
  }
}

// Returns the sign of the side of the line through a and b on which a point lies; 0 on it.
int side(Vec2 a, Vec2 b, Vec2 p) {
  const double area = cross(b - a, p - a);
  return (area > 0) - (area < 0);
}

bool cross_each_other(const Edge& a, const Edge& b) {
  return side(a.from, a.to, b.from) * side(a.from, a.to, b.to) < 0 &&
         side(b.from, b.to, a.from) * side(b.from, b.to, a.to) < 0;
}

}  // namespace

std::vector<LineSegment> polygon_walls(const Polygons& polygons, const PolygonCrossings& crossings) {
  std::vector<Edge> edges;
  for (const auto* rings : {&polygons.solid, &polygons.holes})
    for (const Ring& ring : *rings) {
      const std::vector<Edge> more = edges_of(ring);
      edges.insert(edges.end(), more.begin(), more.end());
    }
  const Extent extent(edges);
  const double room = nearest_lines * extent.size + rounding * extent.farthest;
  const double step = beside * extent.size + 10 * rounding * extent.farthest;
  std::vector<std::vector<double>> cuts(edges.size());
  find_neighbours(edges, room, [&](size_t a, size_t b) {
    cut_each_other(edges[a], cuts[a], edges[b], cuts[b], room);
    return false;
  });
  std::vector<LineSegment> walls;
  for (size_t n = 0; n < edges.size(); ++n) append_walls(edges[n], cuts[n], step, crossings, walls);
  return walls;
}

std::optional<std::array<size_t, 2>> find_self_crossing(const Ring& ring) {
  const std::vector<Edge> edges = edges_of(ring);
  std::optional<std::array<size_t, 2>> found;
  find_neighbours(edges, 0, [&](size_t a, size_t b) {
    if (!cross_each_other(edges[a], edges[b])) return false;
    found = {std::min(a, b), std::max(a, b)};
    return true;
  });
  return found;
}

}  // namespace ombre::importing
