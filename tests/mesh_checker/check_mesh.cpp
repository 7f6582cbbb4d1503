// Says of .off files what CGAL finds: is the surface a closed manifold, how many pairs of triangles intersect, its
// volume.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iostream>

#include "off_soup.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

void check(const std::string& path) {
  const Soup<Kernel::Point_3> soup = read_off<Kernel::Point_3>(path);
  const bool is_manifold = processing::is_polygon_soup_a_polygon_mesh(soup.triangles);
  std::cout << "{\"manifold\": " << (is_manifold ? "true" : "false");
  if (is_manifold) {
    Mesh mesh;
    processing::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    processing::self_intersections(mesh, std::back_inserter(pairs));
    const bool is_closed = CGAL::is_closed(mesh);
    std::cout << ", \"closed\": " << (is_closed ? "true" : "false") << ", \"intersections\": " << pairs.size()
              << ", \"volume\": " << (is_closed ? CGAL::to_double(processing::volume(mesh)) : 0);
  }
  std::cout << "}\n";
}

}  // namespace

int main(int count, char** arguments) {
  std::cout.precision(12);
  for (int n = 1; n < count; ++n) check(arguments[n]);
}
