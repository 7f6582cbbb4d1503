// The edges of a mesh, with vertices at the same place as one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/mesh/mesh.h"

namespace ombre::importing {

// Triangles whose vertices at exactly the same place are merged.
struct PlacedTriangles {
  std::vector<Vec3> places;
  std::vector<uint32_t> place_of;  // by vertex of the mesh
  std::vector<std::array<uint32_t, 3>> triangles;
};

PlacedTriangles placed_triangles(const formats::Mesh& mesh);

// A side of a triangle, directed as the triangle runs.
struct FacetEdge {
  uint32_t from = 0, to = 0, triangle = 0;

  uint32_t lesser() const { return from < to ? from : to; }
  uint32_t greater() const { return from < to ? to : from; }
  int direction() const { return from < to ? 1 : -1; }
};

// Returns all sides with a length, sorted so that those between the same two places are adjacent.
std::vector<FacetEdge> sorted_edges(const std::vector<std::array<uint32_t, 3>>& triangles);

// Calls `visit` once for each pair of places, with the sides between them.
template <class Visit>
void for_each_edge(std::span<const FacetEdge> edges, const Visit& visit) {
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].lesser() == edges[begin].lesser() &&
           edges[end].greater() == edges[begin].greater())
      ++end;
    visit(edges.subspan(begin, end - begin));
  }
}

// Returns the number of triangles that run along an edge one way less those that run the other way; 0 if the surface is
// closed there.
inline int64_t balance(std::span<const FacetEdge> edge) {
  int64_t sum = 0;
  for (const FacetEdge& side : edge) sum += side.direction();
  return sum;
}

}  // namespace ombre::importing
