// Finds defects of a mesh, and measures it.
#include "import/surfaces/mesh_report.h"

#include <algorithm>
#include <span>

#include "import/surfaces/mesh_edges.h"
#include "import/surfaces/shells.h"

namespace ombre::importing {
namespace {

constexpr size_t most_examples = 5;

void check_edges(std::span<const FacetEdge> edges, const std::vector<Vec3>& places, MeshReport& report) {
  for_each_edge(edges, [&](std::span<const FacetEdge> edge) {
    if (balance(edge) == 0) return;
    ++(edge.size() % 2 == 1 ? report.open_edges : report.inconsistent_edges);
    if (report.examples.size() < most_examples)
      report.examples.push_back({places[edge[0].lesser()], places[edge[0].greater()]});
  });
}

// Measures relative to the centre, which keeps precision for meshes far from the origin.
void measure(const PlacedTriangles& placed, const std::vector<uint32_t>& shell_of, MeshReport& report) {
  const auto& [places, place_of, triangles] = placed;
  for (const auto& t : triangles)
    for (const uint32_t i : t) report.bounds = hull(report.bounds, Box{places[i], places[i]});
  const Vec3 center = report.bounds.is_empty() ? Vec3{} : report.bounds.center();
  std::vector<double> volumes;  // volume of each shell
  for (size_t n = 0; n < triangles.size(); ++n) {
    const auto& t = triangles[n];
    const Vec3 a = places[t[0]] - center, b = places[t[1]] - center, c = places[t[2]] - center;
    const Vec3 doubled = cross(b - a, c - a);
    if (doubled == Vec3{}) ++report.degenerate;
    report.area += length(doubled) / 2;
    const double volume = dot(a, cross(b, c)) / 6;
    report.volume += volume;
    if (shell_of.empty()) continue;
    if (shell_of[n] >= volumes.size()) volumes.push_back(0);
    volumes[shell_of[n]] += volume;
  }
  report.shells = volumes.size();
  report.inward_shells =
      static_cast<size_t>(std::count_if(volumes.begin(), volumes.end(), [](double v) { return v < 0; }));
}

}  // namespace

MeshReport inspect(const formats::Mesh& mesh) {
  MeshReport report;
  report.triangles = mesh.triangles.size();
  const PlacedTriangles placed = placed_triangles(mesh);
  const std::vector<FacetEdge> edges = sorted_edges(placed.triangles);
  check_edges(edges, placed.places, report);
  measure(placed, report.is_closed() ? shells_of(placed.triangles.size(), edges) : std::vector<uint32_t>(), report);
  return report;
}

}  // namespace ombre::importing
