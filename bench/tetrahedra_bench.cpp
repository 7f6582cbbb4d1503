// CGAL's Mesh_3 alone on the implicit solids of bench/simulations.py, with the criteria of src/solids/mesh_module.h.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "solids/mesh_module.h"

namespace {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Geometry::Point_3;
using Domain = CGAL::Labeled_mesh_domain_3<Geometry>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Clock = std::chrono::steady_clock;
namespace params = CGAL::parameters;
using namespace ombre::solids;

double ball(const Point& p) { return p.x() * p.x() + p.y() * p.y() + p.z() * p.z() - 81; }

double sponge(const Point& p) {
  const double k = M_PI / 4;
  return ball(p) + 30 * (std::sin(k * p.x()) * std::cos(k * p.y()) + std::sin(k * p.y()) * std::cos(k * p.z()) +
                         std::sin(k * p.z()) * std::cos(k * p.x()));
}

double least_dihedral(const Complex& complex) {
  const auto bare = complex.triangulation().geom_traits().construct_point_3_object();
  double least = 180;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) {
        const int c = a > 0 ? 0 : b > 1 ? 1 : 2;
        const int d = 6 - a - b - c;
        const auto at = [&](int n) { return bare(complex.triangulation().point(cell, n)); };
        least = std::min(least, std::abs(CGAL::approximate_dihedral_angle(at(a), at(b), at(c), at(d))));
      }
  return least;
}

double volume(const Complex& complex) {
  double sum = 0;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    sum += complex.triangulation().tetrahedron(cell).volume();
  return sum;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string shape = count == 3 ? arguments[1] : "";
  if (shape != "ball" && shape != "sponge") {
    std::fprintf(stderr, "bench_tetrahedra ball|sponge SIZE\n");
    return 2;
  }
  const double size = std::atof(arguments[2]);
  const auto begin = Clock::now();
  const auto domain =
      Domain::create_implicit_mesh_domain(params::function = shape == "ball" ? ball : sponge,
                                          params::bounding_object = Geometry::Sphere_3(CGAL::ORIGIN, 14 * 14),
                                          params::relative_error_bound = surface_error * size / 28);
  const Criteria criteria(params::facet_angle = least_angle, params::facet_size = facet_share * size,
                          params::facet_distance = 0.05 * size, params::cell_radius_edge_ratio = most_radius_to_edge,
                          params::cell_size = cell_share * size);
  const auto made = CGAL::make_mesh_3<Complex>(domain, criteria);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  std::printf("{\"seconds\": %.6f, \"tetrahedra\": %zu, \"least_dihedral_degrees\": %.3f, \"volume_mm3\": %.3f}\n",
              seconds, made.number_of_cells_in_complex(), least_dihedral(made), volume(made));
}
