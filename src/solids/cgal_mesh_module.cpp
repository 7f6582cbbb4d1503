// Tetrahedra by CGAL's Mesh_3.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "base/error.h"
#include "solids/tetrahedra.h"

namespace ombre::solids {
namespace {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Geometry::Point_3;
using Domain = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Labeled_mesh_domain_3<Geometry>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

// Of the size: radii of the balls around facets and cells, so that the mean edge has about the size, and how far
// facets may lie from the surface.
constexpr double facet_share = 0.8, cell_share = 0.8, distance_share = 0.05;
constexpr double least_angle = 25, most_radius_to_edge = 2.2;
// How near to the surface its points lie, as a share of the size.
constexpr double surface_error = 1e-4;

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

// A size that depends on the point, as criteria ask for it.
struct Sizing {
  using FT = Geometry::FT;
  using Point_3 = Point;
  const std::function<double(Vec3)>* size_mm;
  double share;
  template <class P, class Index>
  FT operator()(const P& p, int /*dimension*/, const Index& /*index*/) const {
    return share * (*size_mm)({p.x(), p.y(), p.z()});
  }
};

// Ascending, but for the last two where the order would turn the tetrahedron inside out.
void sort_evenly(std::array<uint32_t, 4>& nodes) {
  bool is_odd = false;
  for (size_t a = 0; a < 4; ++a)
    for (size_t b = a + 1; b < 4; ++b) is_odd ^= nodes[a] > nodes[b];
  std::sort(nodes.begin(), nodes.end());
  if (is_odd) std::swap(nodes[2], nodes[3]);
}

Tetrahedra in_order(const Complex& complex) {
  const Triangulation& triangulation = complex.triangulation();
  std::vector<Point> points;
  std::map<Triangulation::Vertex_handle, uint32_t> numbers;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    for (int n = 0; n < 4; ++n)
      if (numbers.emplace(cell->vertex(n), static_cast<uint32_t>(points.size())).second)
        points.push_back(triangulation.geom_traits().construct_point_3_object()(triangulation.point(cell->vertex(n))));
  std::vector<uint32_t> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](uint32_t n) { return std::array{points[n].z(), points[n].y(), points[n].x()}; };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  Tetrahedra made;
  for (uint32_t n = 0; n < order.size(); ++n) {
    place[order[n]] = n;
    made.points.push_back(vec(points[order[n]]));
  }
  struct Cell {
    std::array<uint32_t, 4> nodes;
    uint32_t region;
  };
  std::vector<Cell> cells;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    Cell here{{}, static_cast<uint32_t>(complex.subdomain_index(cell))};
    for (int n = 0; n < 4; ++n) here.nodes[static_cast<size_t>(n)] = place[numbers.at(cell->vertex(n))];
    sort_evenly(here.nodes);
    cells.push_back(here);
  }
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.nodes < b.nodes; });
  for (const Cell& cell : cells) {
    made.nodes.push_back(cell.nodes);
    made.regions.push_back(cell.region);
  }
  return made;
}

Tetrahedra make(const TetrahedraRequest& request) {
  namespace params = CGAL::parameters;
  CGAL::get_default_random() = CGAL::Random(0);
  CGAL::Random random(0);
  const Box& box = request.box;
  const Geometry::Iso_cuboid_3 around(Point(box.lo.x, box.lo.y, box.lo.z), Point(box.hi.x, box.hi.y, box.hi.z));
  const auto region = [&](const Point& p) { return static_cast<int>(request.region(vec(p))); };
  Domain domain(params::function = region, params::bounding_object = around, params::p_rng = &random,
                params::relative_error_bound = surface_error * request.least_size_mm / length(box.size()));
  std::vector<std::vector<Point>> edges;
  for (const Polyline& line : request.sharp_edges) {
    edges.emplace_back();
    for (const Vec3& p : line) edges.back().emplace_back(p.x, p.y, p.z);
  }
  domain.add_features(edges.begin(), edges.end());
  for (const Vec3& p : request.fixed_points) domain.add_corner(Point(p.x, p.y, p.z));
  const Sizing edge{&request.size_mm, 1}, facet{&request.size_mm, facet_share}, cell{&request.size_mm, cell_share},
      distance{&request.size_mm, distance_share};
  const Criteria criteria(params::edge_size = edge, params::facet_angle = least_angle, params::facet_size = facet,
                          params::facet_distance = distance, params::cell_radius_edge_ratio = most_radius_to_edge,
                          params::cell_size = cell);
  const Complex complex =
      CGAL::make_mesh_3<Complex>(domain, criteria, params::features(domain), params::no_lloyd(), params::no_odt(),
                                 params::perturb(params::sliver_bound = 12), params::exude(params::sliver_bound = 12));
  return in_order(complex);
}

}  // namespace
}  // namespace ombre::solids

extern "C" void ombre_make_tetrahedra(const ombre::solids::TetrahedraRequest& request,
                                      ombre::solids::Tetrahedra& made) {
  try {
    made = ombre::solids::make(request);
  } catch (const ombre::Error&) {
    throw;
  } catch (const std::logic_error& failure) {
    throw ombre::Error(std::string("the tetrahedra could not be made: ") + failure.what());
  }
}
