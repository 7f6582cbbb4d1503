#include "import/surfaces/mesh_edges.h"

#include <algorithm>

#include "formats/mesh/vertex_merger.h"

namespace ombre::importing {

PlacedTriangles placed_triangles(const formats::Mesh& mesh) {
  PlacedTriangles placed;
  formats::VertexMerger merger;
  placed.place_of.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) placed.place_of.push_back(merger.add(p));
  placed.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    placed.triangles.push_back({placed.place_of[a], placed.place_of[b], placed.place_of[c]});
  placed.places = merger.take_places();
  return placed;
}

std::vector<FacetEdge> sorted_edges(const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::vector<FacetEdge> edges;
  edges.reserve(3 * triangles.size());
  for (uint32_t n = 0; n < triangles.size(); ++n)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = triangles[n][i], to = triangles[n][(i + 1) % 3];
      if (from != to) edges.push_back({from, to, n});
    }
  std::sort(edges.begin(), edges.end(), [](const FacetEdge& x, const FacetEdge& y) {
    return x.lesser() != y.lesser() ? x.lesser() < y.lesser() : x.greater() < y.greater();
  });
  return edges;
}

}  // namespace ombre::importing
