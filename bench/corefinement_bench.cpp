// Times CGAL's corefinement alone on the ball less ten of bench_solids.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "base/stopwatch.h"

namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Exact::Point_3>;

// Makes a ball as OpenSCAD does, with rings at half steps from the poles.
Mesh sphere(double radius, int edges, double x, double y, double z) {
  Mesh mesh;
  const int rings = (edges + 1) / 2;
  std::vector<Mesh::Vertex_index> v;
  for (int ring = rings - 1; ring >= 0; --ring) {
    const double polar = M_PI * (ring + 0.5) / rings;
    for (int n = 0; n < edges; ++n) {
      const double around = 2 * M_PI * n / edges;
      v.push_back(mesh.add_vertex({x + radius * std::sin(polar) * std::cos(around),
                                   y + radius * std::sin(polar) * std::sin(around), z + radius * std::cos(polar)}));
    }
  }
  const auto at = [&](int ring, int n) { return v[static_cast<size_t>(ring * edges + n % edges)]; };
  for (int ring = 0; ring + 1 < rings; ++ring)
    for (int n = 0; n < edges; ++n) {
      mesh.add_face(at(ring, n), at(ring, n + 1), at(ring + 1, n + 1));
      mesh.add_face(at(ring, n), at(ring + 1, n + 1), at(ring + 1, n));
    }
  for (int n = 2; n < edges; ++n) {
    mesh.add_face(at(0, 0), at(0, n), at(0, n - 1));
    mesh.add_face(at(rings - 1, 0), at(rings - 1, n - 1), at(rings - 1, n));
  }
  return mesh;
}

}  // namespace

int main() {
  for (const int edges : {40, 100}) {
    const ombre::Stopwatch watch;
    Mesh ball = sphere(10, edges, 0, 0, 0);
    bool good = true;
    for (int n = 0; n < 10; ++n) {
      Mesh other = sphere(3, edges, 9 * std::cos(0.7 * n), 9 * std::sin(0.7 * n), n - 4.5);
      good &= CGAL::Polygon_mesh_processing::corefine_and_compute_difference(ball, other, ball);
    }
    std::printf("corefinement, $fn=%d %7.3f s  %zu triangles%s\n", edges, watch.seconds(), num_faces(ball),
                good ? "" : "  failed");
  }
}
