// Finds where a surface is not closed.
#include "import/surfaces/open_edges.h"

#include <algorithm>
#include <cmath>

#include "import/fields/triangle_distance.h"
#include "import/surfaces/mesh_edges.h"

namespace ombre::importing {
namespace {

// Greatest cosine between an edge of a gap and the opposite edge, which runs back.
constexpr double runs_back = -0.7;
// Greatest number of edges whose distance to the opposite border is measured.
constexpr size_t most_measured = 300;

using LooseEdge = std::array<Vec3, 2>;

bool is_opposite(const LooseEdge& a, const LooseEdge& b) {
  const Vec3 along = a[1] - a[0], other = b[1] - b[0];
  return dot(along, other) < runs_back * length(along) * length(other);
}

// Returns the distance from the edge's middle to the nearest edge that runs the other way.
double gap_at(const LooseEdge& edge, const std::vector<LooseEdge>& edges) {
  const Vec3 middle = 0.5 * (edge[0] + edge[1]);
  double least = std::numeric_limits<double>::infinity();
  for (const LooseEdge& other : edges)
    if (is_opposite(edge, other)) least = std::min(least, squared_distance_to_segment(middle, other[0], other[1]));
  return std::sqrt(least);
}

double widest_gap(const std::vector<LooseEdge>& edges) {
  const size_t step = 1 + edges.size() / most_measured;
  double widest = 0;
  for (size_t n = 0; n < edges.size(); n += step) widest = std::max(widest, gap_at(edges[n], edges));
  return widest;
}

}  // namespace

std::optional<OpenEdges> find_open_edges(const formats::Mesh& mesh) {
  const PlacedTriangles placed = placed_triangles(mesh);
  const std::vector<FacetEdge> sides = sorted_edges(placed.triangles);
  std::vector<LooseEdge> edges;
  for_each_edge(sides, [&](std::span<const FacetEdge> edge) {
    const int64_t sum = balance(edge);
    if (sum == 0) return;
    const Vec3 lesser = placed.places[edge[0].lesser()], greater = placed.places[edge[0].greater()];
    edges.push_back(sum > 0 ? LooseEdge{lesser, greater} : LooseEdge{greater, lesser});
  });
  if (edges.empty()) return std::nullopt;
  return OpenEdges{edges.size(), edges.front(), widest_gap(edges)};
}

}  // namespace ombre::importing
