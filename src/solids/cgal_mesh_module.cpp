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
using Usual = CGAL::Mesh_criteria_3<Triangulation>;

// Shares of the element size: radii of the balls around facets and cells, so that the mean edge has about the size, and
// how far facets may lie from the surface.
constexpr double facet_share = 0.8, cell_share = 0.8, distance_share = 0.05;
constexpr double least_angle = 25, most_radius_to_edge = 2.2;
// How near to the surface its points lie, as a share of the size.
constexpr double surface_error = 1e-4;

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

// Facets and cells with a shorter edge, in sizes, are left as they are: where surfaces meet in a sharp angle that is no
// protected edge, refinement would not end.
constexpr double least_edge = 0.03;

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

// Is an edge between these corners of a cell too short to refine what has it?
template <size_t count>
bool is_small(const Triangulation& triangulation, Triangulation::Cell_handle cell,
              const std::array<int, count>& corners, const std::function<double(Vec3)>& size_mm) {
  std::array<Vec3, count> points;
  const auto bare = triangulation.geom_traits().construct_point_3_object();
  for (size_t n = 0; n < count; ++n) points[n] = vec(bare(triangulation.point(cell, corners[n])));
  const double least = least_edge * size_mm(points[0]);
  for (size_t a = 0; a < count; ++a)
    for (size_t b = a + 1; b < count; ++b)
      if (length(points[a] - points[b]) < least) return true;
  return false;
}

// The usual criteria, but for what has become small.
struct LimitedFacets {
  using Base = Usual::Facet_criteria;
  using Facet_quality = Base::Facet_quality;
  using Is_facet_bad = Base::Is_facet_bad;

  Base base;
  const std::function<double(Vec3)>* size_mm;

  Is_facet_bad operator()(const Triangulation& triangulation, const Triangulation::Facet& facet) const {
    std::array<int, 3> corners{};
    for (int n = 0; n < 3; ++n) corners[static_cast<size_t>(n)] = (facet.second + n + 1) % 4;
    return is_small(triangulation, facet.first, corners, *size_mm) ? Is_facet_bad() : base(triangulation, facet);
  }
};
struct LimitedCells {
  using Base = Usual::Cell_criteria;
  using Cell_quality = Base::Cell_quality;
  using Is_cell_bad = Base::Is_cell_bad;

  Base base;
  const std::function<double(Vec3)>* size_mm;

  Is_cell_bad operator()(const Triangulation& triangulation, const Triangulation::Cell_handle& cell) const {
    const bool is_fine = is_small(triangulation, cell, std::array{0, 1, 2, 3}, *size_mm);
    return is_fine ? Is_cell_bad() : base(triangulation, cell);
  }
};

class Criteria {
 public:
  using Edge_criteria = Usual::Edge_criteria;
  using Facet_criteria = LimitedFacets;
  using Cell_criteria = LimitedCells;

  Criteria(const Usual& usual, const std::function<double(Vec3)>& size_mm)
      : edges_(usual.edge_criteria_object()),
        facets_{usual.facet_criteria_object(), &size_mm},
        cells_{usual.cell_criteria_object(), &size_mm} {}

  const Edge_criteria& edge_criteria_object() const { return edges_; }
  const Facet_criteria& facet_criteria_object() const { return facets_; }
  const Cell_criteria& cell_criteria_object() const { return cells_; }

 private:
  Edge_criteria edges_;
  Facet_criteria facets_;
  Cell_criteria cells_;
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
  const Usual usual(params::edge_size = edge, params::facet_angle = least_angle, params::facet_size = facet,
                    params::facet_distance = distance, params::cell_radius_edge_ratio = most_radius_to_edge,
                    params::cell_size = cell);
  const Criteria criteria(usual, request.size_mm);
  // 0 is no limit. By default the steps that mend slivers stop after as many seconds as meshing took, so that each run
  // would give another mesh.
  const Complex complex =
      CGAL::make_mesh_3<Complex>(domain, criteria, params::features(domain), params::no_lloyd(), params::no_odt(),
                                 params::perturb(params::time_limit = 0, params::sliver_bound = 12),
                                 params::exude(params::time_limit = 0, params::sliver_bound = 12));
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
