// Finds where the edges of a layer's cells cross borders, and places the vertices between the crossings.
#include "surface/outline/outline_crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text/error.h"
#include "surface/cells/border_normals.h"
#include "surface/cells/edge_search.h"
#include "surface/cells/quadric.h"
#include "surface/cells/shortened.h"

namespace ombre::surface {
namespace {

constexpr int32_t block_cells = 32;  // side in cells of the blocks that share a shortened program
constexpr double rounding_cells = 1e-9;
constexpr double corner_room_cells = 2;  // greatest distance of a corner from its cell
// Least length of a normal's component in the plane; below it, the border is nearly level and has no direction there.
constexpr double least_in_plane = 1e-6;

std::array<int32_t, 2> block_of(const OutlineCrossing& c) { return {c.j / block_cells, c.i / block_cells}; }

EdgeSearch edge_of(const OutlineCrossing& crossing, const voxel::Lattice& corners, int64_t k) {
  EdgeSearch search;
  search.start = corners.center(crossing.i, crossing.j, k);
  search.along[crossing.axis] = corners.pitch[crossing.axis].mm();
  search.from = crossing.from;
  search.to = crossing.to;
  return search;
}

Vec2 in_plane(Vec3 normal, int axis) {
  const double length = std::hypot(normal.x, normal.y);
  if (length > least_in_plane) return {normal.x / length, normal.y / length};
  return axis == 0 ? Vec2{1, 0} : Vec2{0, 1};
}

void find_block(const voxel::Lattice& corners, int64_t k, std::span<const uint32_t> block, const Partition& partition,
                PointEvaluator& evaluator, OutlineGraph& graph) {
  const double cell_mm = corners.pitch[0].mm();
  std::vector<EdgeSearch> searches;
  Box box;
  for (const uint32_t n : block) {
    searches.push_back(edge_of(graph.crossings[n], corners, k));
    box = hull(box, {searches.back().point(0), searches.back().point(1)});
  }
  const Box near = box.expanded(normals_reach * cell_mm);
  const program::Program program = shortened_for(partition.details.around(near), near);
  evaluator.begin(partition, program);
  search_edges(searches, evaluator);
  const std::vector<Vec3> normals = border_normals(searches, {cell_mm, cell_mm, cell_mm}, evaluator);
  for (size_t m = 0; m < block.size(); ++m) {
    OutlineCrossing& crossing = graph.crossings[block[m]];
    const Vec3 at = searches[m].point(searches[m].t);
    crossing.at = {at.x, at.y};
    crossing.normal = in_plane(normals[m], crossing.axis);
  }
}

bool is_near(const voxel::Lattice& corners, const OutlineVertex& v, Vec2 p, double room_mm) {
  const Vec3 lo = corners.center(v.i, v.j, 0), hi = corners.center(v.i + 1, v.j + 1, 0);
  return lo.x - room_mm <= p.x && p.x <= hi.x + room_mm && lo.y - room_mm <= p.y && p.y <= hi.y + room_mm;
}

// Returns the sum of squared distances from a point to the borders through a vertex's crossings.
double misfit(const OutlineGraph& graph, const OutlineVertex& vertex, Vec2 p) {
  double sum = 0;
  for (size_t n = 0; n < vertex.count; ++n) {
    const OutlineCrossing& crossing = graph.crossings[vertex.crossings[n]];
    const double distance = dot(crossing.normal, p - crossing.at);
    sum += distance * distance;
  }
  return sum;
}

// Returns the point between a and b with the least misfit.
Vec2 best_between(const OutlineGraph& graph, const OutlineVertex& vertex, Vec2 a, Vec2 b) {
  double slope = 0, curvature = 0;
  for (size_t n = 0; n < vertex.count; ++n) {
    const OutlineCrossing& crossing = graph.crossings[vertex.crossings[n]];
    const double rise = dot(crossing.normal, b - a);
    slope += rise * dot(crossing.normal, a - crossing.at);
    curvature += rise * rise;
  }
  const double t = curvature > 0 ? std::clamp(-slope / curvature, 0.0, 1.0) : 0.5;
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

}  // namespace

void find_outline_crossings(const Partition& partition, const voxel::Lattice& corners, int64_t k, OutlineGraph& graph,
                            const StopFlag* stop) {
  std::vector<uint32_t> order(graph.crossings.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto block = [&](uint32_t n) { return block_of(graph.crossings[n]); };
  std::ranges::stable_sort(order, {}, block);
  PointEvaluator evaluator;
  for (size_t begin = 0; begin < order.size();) {
    if (stop && stop->requested()) throw Cancelled();
    size_t end = begin + 1;
    while (end < order.size() && block(order[end]) == block(order[begin])) ++end;
    find_block(corners, k, std::span(order).subspan(begin, end - begin), partition, evaluator, graph);
    begin = end;
  }
}

Vec2 mean_point(const OutlineGraph& graph, const OutlineVertex& vertex) {
  Vec2 sum;
  for (size_t n = 0; n < vertex.count; ++n) {
    const Vec2 at = graph.crossings[vertex.crossings[n]].at;
    sum = {sum.x + at.x, sum.y + at.y};
  }
  return {sum.x / vertex.count, sum.y / vertex.count};
}

Vec2 point_on_cell(const voxel::Lattice& corners, const OutlineGraph& graph, const OutlineVertex& vertex) {
  const Vec3 lo = corners.center(vertex.i, vertex.j, 0), hi = corners.center(vertex.i + 1, vertex.j + 1, 0);
  const std::array<Vec2, 4> around{{{lo.x, lo.y}, {hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}}};
  Vec2 best = around[0];
  for (size_t n = 0; n < 4; ++n) {
    const Vec2 p = best_between(graph, vertex, around[n], around[(n + 1) % 4]);
    if (misfit(graph, vertex, p) < misfit(graph, vertex, best)) best = p;
  }
  return best;
}

bool is_in_cell(const voxel::Lattice& corners, const OutlineVertex& vertex) {
  return is_near(corners, vertex, vertex.at, rounding_cells * corners.pitch[0].mm());
}

void place_outline_vertices(const voxel::Lattice& corners, OutlineGraph& graph) {
  for (OutlineVertex& vertex : graph.vertices) {
    Quadric planes;
    for (size_t n = 0; n < vertex.count; ++n) {
      const OutlineCrossing& crossing = graph.crossings[vertex.crossings[n]];
      planes.add({crossing.at.x, crossing.at.y, 0}, {crossing.normal.x, crossing.normal.y, 0});
    }
    const Vec3 best = planes.least().at;
    vertex.at = {best.x, best.y};
    const bool is_usable = is_near(corners, vertex, vertex.at, corner_room_cells * corners.pitch[0].mm());
    if (!is_usable) vertex.at = point_on_cell(corners, graph, vertex);
  }
}

}  // namespace ombre::surface
