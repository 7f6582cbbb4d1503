// Times CGAL's corefinement alone on the ball less ten, and on the plate with 300 holes, of bench_solids.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Exact::Point_3>;

// Returns processor time, since other programs on the machine lengthen wall time.
double seconds_since(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

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

// Adds a prism along z. Its corners are counter-clockwise when seen from above.
void add_prism(Mesh& mesh, const std::vector<std::pair<double, double>>& corners, double foot, double top) {
  std::vector<Mesh::Vertex_index> below, above;
  for (const auto& [x, y] : corners) {
    below.push_back(mesh.add_vertex({x, y, foot}));
    above.push_back(mesh.add_vertex({x, y, top}));
  }
  for (size_t n = 0; n < corners.size(); ++n) {
    const size_t next = (n + 1) % corners.size();
    mesh.add_face(below[n], below[next], above[next]);
    mesh.add_face(below[n], above[next], above[n]);
  }
  for (size_t n = 2; n < corners.size(); ++n) {
    mesh.add_face(below[0], below[n], below[n - 1]);
    mesh.add_face(above[0], above[n - 1], above[n]);
  }
}

void time_plate() {
  const std::clock_t begin = std::clock();
  Mesh plate, holes;
  add_prism(plate, {{0, 0}, {80, 0}, {80, 60}, {0, 60}}, 0, 3);
  constexpr int edges = 30;
  for (int n = 0; n < 300; ++n) {
    std::vector<std::pair<double, double>> circle;
    for (int k = 0; k < edges; ++k)
      circle.emplace_back(2.0 + 4 * (n % 20) + 1.5 * std::cos(2 * M_PI * k / edges),
                          2.0 + 4 * (n / 20) + 1.5 * std::sin(2 * M_PI * k / edges));
    add_prism(holes, circle, -1, 4);
  }
  const bool good = CGAL::Polygon_mesh_processing::corefine_and_compute_difference(plate, holes, plate);
  std::printf("corefinement, plate   %7.3f s  %zu triangles%s\n", seconds_since(begin), num_faces(plate),
              good ? "" : "  failed");
}

}  // namespace

int main() {
  for (const int edges : {40, 100}) {
    const std::clock_t begin = std::clock();
    Mesh ball = sphere(10, edges, 0, 0, 0);
    bool good = true;
    for (int n = 0; n < 10; ++n) {
      Mesh other = sphere(3, edges, 9 * std::cos(0.7 * n), 9 * std::sin(0.7 * n), n - 4.5);
      good &= CGAL::Polygon_mesh_processing::corefine_and_compute_difference(ball, other, ball);
    }
    std::printf("corefinement, $fn=%d %7.3f s  %zu triangles%s\n", edges, seconds_since(begin), num_faces(ball),
                good ? "" : "  failed");
  }
  time_plate();
}
