// What is wrong with a mesh, and how large it is.
#include "import/mesh_report.h"

#include <algorithm>
#include <cstdlib>

#include "formats/vertex_merger.h"

namespace ombre::importing {
namespace {

constexpr size_t most_examples = 5;

// An edge between two places, the lesser first, and which way a triangle runs along it.
struct FacetEdge {
  uint32_t a = 0, b = 0;
  int direction = 1;
};

std::vector<std::array<uint32_t, 3>> merge_places(const formats::Mesh& mesh, formats::VertexMerger& merger) {
  std::vector<uint32_t> place_of;
  place_of.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) place_of.push_back(merger.add(p));
  std::vector<std::array<uint32_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) triangles.push_back({place_of[t[0]], place_of[t[1]], place_of[t[2]]});
  return triangles;
}

std::vector<FacetEdge> sorted_edges(const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::vector<FacetEdge> edges;
  edges.reserve(3 * triangles.size());
  for (const auto& t : triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = t[i], to = t[(i + 1) % 3];
      if (from < to) edges.push_back({from, to, 1});
      if (from > to) edges.push_back({to, from, -1});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const FacetEdge& x, const FacetEdge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  return edges;
}

void check_edges(const std::vector<FacetEdge>& edges, const std::vector<Vec3>& places, MeshReport& report) {
  for (size_t i = 0; i < edges.size();) {
    const FacetEdge& edge = edges[i];
    size_t uses = 0;
    int64_t balance = 0;
    for (; i < edges.size() && edges[i].a == edge.a && edges[i].b == edge.b; ++i) {
      ++uses;
      balance += edges[i].direction;
    }
    if (balance == 0) continue;
    ++(uses % 2 == 1 ? report.open_edges : report.inconsistent_edges);
    if (report.examples.size() < most_examples) report.examples.push_back({places[edge.a], places[edge.b]});
  }
}

// About the centre, which keeps digits for meshes far from the origin.
void measure(const std::vector<std::array<uint32_t, 3>>& triangles, const std::vector<Vec3>& places,
             MeshReport& report) {
  for (const auto& t : triangles)
    for (const uint32_t i : t) report.bounds = hull(report.bounds, Box{places[i], places[i]});
  const Vec3 center = report.bounds.is_empty() ? Vec3{} : report.bounds.center();
  for (const auto& t : triangles) {
    const Vec3 a = places[t[0]] - center, b = places[t[1]] - center, c = places[t[2]] - center;
    const Vec3 doubled = cross(b - a, c - a);
    if (doubled == Vec3{}) ++report.degenerate;
    report.area += length(doubled) / 2;
    report.volume += dot(a, cross(b, c)) / 6;
  }
}

}  // namespace

MeshReport inspect(const formats::Mesh& mesh) {
  MeshReport report;
  report.triangles = mesh.triangles.size();
  formats::VertexMerger merger;
  const auto triangles = merge_places(mesh, merger);
  check_edges(sorted_edges(triangles), merger.places(), report);
  measure(triangles, merger.places(), report);
  return report;
}

}  // namespace ombre::importing
