// Says of .off files what CGAL finds: is the surface a closed manifold, how many pairs of triangles intersect, how many
// only touch in corners that exist once for each sheet there, its volume.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "off_soup.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Corners = std::array<Point, 3>;
namespace processing = CGAL::Polygon_mesh_processing;

Corners corners_of(const Mesh& mesh, Mesh::Face_index face) {
  Corners corners;
  auto next = corners.begin();
  for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) *next++ = mesh.point(vertex);
  return corners;
}

bool has(const Corners& corners, const Point& point) { return std::ranges::find(corners, point) != corners.end(); }

// Those of `of` that `other` has too come first; says how many.
size_t shared_first(Corners& of, const Corners& other) {
  return static_cast<size_t>(
      std::stable_partition(of.begin(), of.end(), [&](const Point& p) { return has(other, p); }) - of.begin());
}

bool meets(const Corners& triangle, const Point& from, const Point& to) {
  return CGAL::do_intersect(Kernel::Triangle_3(triangle[0], triangle[1], triangle[2]), Kernel::Segment_3(from, to));
}

// Whether triangles meet nowhere but in corners at the same places: in one, or in the two ends of a side.
bool only_touch(Corners a, Corners b) {
  const size_t shared = shared_first(a, b);
  if (shared == 0 || shared == 3 || shared_first(b, a) != shared) return false;
  if (shared == 1) return !meets(a, b[1], b[2]) && !meets(b, a[1], a[2]);
  return !CGAL::coplanar(a[0], a[1], a[2], b[2]) ||
         CGAL::coplanar_orientation(a[0], a[1], a[2], b[2]) == CGAL::NEGATIVE;
}

void check(const std::string& path) {
  const Soup<Kernel::Point_3> soup = read_off<Kernel::Point_3>(path);
  const bool is_manifold = processing::is_polygon_soup_a_polygon_mesh(soup.triangles);
  std::cout << "{\"manifold\": " << (is_manifold ? "true" : "false");
  if (is_manifold) {
    Mesh mesh;
    processing::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    processing::self_intersections(mesh, std::back_inserter(pairs));
    const auto touching = std::ranges::count_if(pairs, [&](const auto& pair) {
      return only_touch(corners_of(mesh, pair.first), corners_of(mesh, pair.second));
    });
    const bool is_closed = CGAL::is_closed(mesh);
    std::cout << ", \"closed\": " << (is_closed ? "true" : "false")
              << ", \"intersections\": " << static_cast<std::ptrdiff_t>(pairs.size()) - touching
              << ", \"touching\": " << touching
              << ", \"volume\": " << (is_closed ? CGAL::to_double(processing::volume(mesh)) : 0);
  }
  std::cout << "}\n";
}

}  // namespace

int main(int count, char** arguments) {
  std::cout.precision(12);
  for (int n = 1; n < count; ++n) check(arguments[n]);
}
