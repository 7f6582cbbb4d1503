#include "surface/mesh/quad_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace ombre::surface {
namespace {

// Limit for the angle between two normals around a vertex, times the width of a cell in tolerances. Below it, the
// surface between vertices a cell's diagonal apart is off by at most about a third of the tolerance.
constexpr double calm_radians_of_cells = 2;

// The corners of a quad after clusters were joined: 0, 3 or 4.
struct Polygon {
  std::array<uint32_t, 4> corners{};
  size_t count = 0;
};

Polygon without_repeats(const std::array<uint32_t, 4>& corners) {
  Polygon polygon;
  for (size_t n = 0; n < 4; ++n)
    if (corners[n] != corners[(n + 1) % 4]) polygon.corners[polygon.count++] = corners[n];
  const bool is_flat = corners[0] == corners[2] || corners[1] == corners[3];
  if (polygon.count < 3 || (is_flat && polygon.count != 3)) polygon.count = 0;
  return polygon;
}

// Quality of two triangles: the least cosine between their normals and the border's, and their least height in mm.
struct Fit {
  double agreement = 1, height = 1e300;
};
Fit fit_of(const QuadSurface& surface, const std::array<Triangle, 2>& triangles, Vec3 normal) {
  Fit fit;
  for (const Triangle& t : triangles) {
    const std::array<Vec3, 3> at = surface.corners(t);
    const Vec3 n = surface.normal(t);
    double longest = 1e-300;
    for (size_t side = 0; side < 3; ++side) longest = std::max(longest, length(at[(side + 1) % 3] - at[side]));
    fit.agreement = std::min(fit.agreement, dot(n, normal) / std::max(length(n), 1e-300));
    fit.height = std::min(fit.height, length(n) / longest);
  }
  return fit;
}

// Splits a polygon into triangles along the diagonal that follows the border better; if both are about equal, along the
// one that avoids slivers.
QuadTriangles triangles_of(const QuadSurface& surface, const Polygon& p, Vec3 normal) {
  const auto& c = p.corners;
  if (p.count == 0) return {};
  if (p.count == 3) return {{{{c[0], c[1], c[2]}}}, 1};
  const std::array<Triangle, 2> first{{{c[0], c[1], c[2]}, {c[0], c[2], c[3]}}};
  const std::array<Triangle, 2> second{{{c[0], c[1], c[3]}, {c[1], c[2], c[3]}}};
  const Fit a = fit_of(surface, first, normal), b = fit_of(surface, second, normal);
  constexpr double about_equal = 0.1;
  const bool take_first =
      std::abs(a.agreement - b.agreement) > about_equal ? a.agreement > b.agreement : a.height >= b.height;
  return {take_first ? first : second, 2};
}

void mix(uint64_t& hash, Vec3 at) {
  for (int axis = 0; axis < 3; ++axis) {
    hash = (hash ^ std::bit_cast<uint64_t>(at[axis])) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32;
  }
}

}  // namespace

QuadSurface::QuadSurface(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh,
                         const ContourOptions& options)
    : crossings_(crossings),
      mesh_(mesh),
      workers_(options.workers),
      least_calm_cosine_(
          std::cos(std::min(1.0, calm_radians_of_cells * options.tolerance_mm / tree.size_mm(grid_level).x))),
      clusters_(tree, crossings, mesh, options.join_flat ? options.tolerance_mm : 0, options.workers),
      triangles_(mesh.quads.size()),
      shape_hashes_(mesh.quads.size()) {
  list_quads_of_vertices();
}

void QuadSurface::list_quads_of_vertices() {
  quad_begins_.assign(mesh_.vertices.size() + 2, 0);
  for (const DualQuad& quad : mesh_.quads)
    for (const uint32_t vertex : quad.corners) ++quad_begins_[vertex + 2];
  std::partial_sum(quad_begins_.begin(), quad_begins_.end(), quad_begins_.begin());
  quads_of_vertices_.resize(4 * mesh_.quads.size());
  for (uint32_t n = 0; n < mesh_.quads.size(); ++n)
    for (const uint32_t vertex : mesh_.quads[n].corners) quads_of_vertices_[quad_begins_[vertex + 1]++] = n;
}

std::array<Vec3, 3> QuadSurface::corners(const Triangle& t) const {
  const std::vector<Vec3>& places = clusters_.places();
  return {places[t[0]], places[t[1]], places[t[2]]};
}

bool QuadSurface::is_calm(uint32_t quad) const {
  const bool is_border_calm = std::ranges::all_of(mesh_.quads[quad].corners, [&](uint32_t vertex) {
    return clusters_.of(vertex) == vertex && mesh_.vertices[vertex].spread.least_cosine() > least_calm_cosine_;
  });
  return is_border_calm && std::ranges::all_of(triangles(quad), [&](const Triangle& triangle) {
           const Vec3 n = normal(triangle);
           return dot(n, crossings_[quad].normal) >= least_calm_cosine_ * length(n);
         });
}

Vec3 QuadSurface::normal(const Triangle& triangle) const {
  const auto [a, b, c] = corners(triangle);
  return cross(b - a, c - a);
}

bool QuadSurface::is_folded(const Triangle& triangle, uint32_t quad) const {
  const Vec3 n = normal(triangle);
  return dot(n, crossings_[quad].normal) < -1e-9 * length(n);
}

bool QuadSurface::is_folded(uint32_t quad) const {
  return std::ranges::any_of(triangles(quad), [&](const Triangle& triangle) { return is_folded(triangle, quad); });
}

std::vector<uint32_t> QuadSurface::folded_quads() const {
  std::vector<uint32_t> folded;
  for (uint32_t quad = 0; quad < quads(); ++quad)
    if (is_folded(quad)) folded.push_back(quad);
  return folded;
}

void QuadSurface::move(uint32_t vertex, Vec3 at) {
  clusters_.move(vertex, at);
  changed_.push_back(vertex);
}

std::vector<uint32_t> QuadSurface::refresh() {
  std::vector<uint32_t> quads;
  if (is_new_) {
    quads.resize(mesh_.quads.size());
    std::iota(quads.begin(), quads.end(), 0U);
  } else {
    for (const uint32_t vertex : changed_) {
      const std::span<const uint32_t> around = quads_around(vertex);
      quads.insert(quads.end(), around.begin(), around.end());
    }
    std::ranges::sort(quads);
    quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
  }
  is_new_ = false;
  changed_.clear();
  constexpr size_t piece = 8192;
  workers_.in_pieces(quads.size(), piece, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n) cut(quads[n]);
  });
  return quads;
}

void QuadSurface::cut(uint32_t quad) {
  std::array<uint32_t, 4> corners{};
  for (size_t n = 0; n < 4; ++n) corners[n] = clusters_.of(mesh_.quads[quad].corners[n]);
  const QuadTriangles triangles = triangles_of(*this, without_repeats(corners), crossings_[quad].normal);
  uint64_t hash = 1;
  for (const Triangle& t : triangles.list())
    for (const uint32_t corner : t) mix(hash, clusters_.places()[corner]);
  if (triangles.count == 0)
    for (const uint32_t corner : corners) mix(hash, clusters_.places()[corner]);
  triangles_[quad] = triangles;
  shape_hashes_[quad] = std::max<uint64_t>(hash, 1);
}

RegionSurface QuadSurface::build() const {
  RegionSurface made;
  std::vector<uint32_t> numbers(clusters_.size(), Cluster::none);
  for (uint32_t quad = 0; quad < quads(); ++quad)
    for (const Triangle& t : triangles(quad)) {
      Facet facet{{}, crossings_[quad].edge.from, crossings_[quad].edge.to};
      for (size_t n = 0; n < 3; ++n) {
        uint32_t& number = numbers[t[n]];
        if (number == Cluster::none) {
          number = static_cast<uint32_t>(made.vertices.size());
          made.vertices.push_back(clusters_.places()[t[n]]);
        }
        facet.corners[n] = number;
      }
      made.report.folded += is_folded(t, quad);
      made.facets.push_back(facet);
    }
  return made;
}

}  // namespace ombre::surface
