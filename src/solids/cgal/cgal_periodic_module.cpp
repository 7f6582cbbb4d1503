// Tetrahedral meshes of a periodic cell, by CGAL's Periodic_3_mesh_3.
// Its header comes first, because it configures the triangulations.
#include <CGAL/Periodic_3_mesh_3/config.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Periodic_3_mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_periodic_3_mesh_3.h>
#include <CGAL/optimize_periodic_3_mesh_3.h>

#include <cmath>
#include <map>

#include "base/text/error.h"
#include "solids/mesh_module.h"

namespace ombre::solids {
namespace {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Geometry::Point_3;
using Domain = CGAL::Labeled_mesh_domain_3<Geometry>;
using Triangulation = CGAL::Periodic_3_mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

// Returns the point of the box that corresponds to p modulo its periods.
Vec3 wrapped(Vec3 p, const Box& box) {
  const Vec3 size = box.size();
  for (int axis = 0; axis < 3; ++axis) p[axis] -= std::floor((p[axis] - box.lo[axis]) / size[axis]) * size[axis];
  return p;
}

void refuse_other_than_cubes(const Box& box) {
  constexpr double same = 1e-9;
  const Vec3 size = box.size();
  for (const double side : {size.y, size.z})
    if (!(std::abs(side - size.x) <= same * size.x))
      throw Error(Code::option, "tetrahedra repeat in cubes alone; choose bricks for other cells");
}

// A position-dependent size, in the form that CGAL's criteria require.
struct Sizing {
  using FT = Geometry::FT;
  using Point_3 = Point;
  const TetrahedraRequest* request;
  double share;
  template <class P, class Index>
  FT operator()(const P& p, int /*dimension*/, const Index& /*index*/) const {
    return share * request->size_mm(wrapped({p.x(), p.y(), p.z()}, request->box));
  }
};

// Corners of cells are copies of vertices, each with an offset in periods along each axis.
Tetrahedra in_order(const Complex& complex) {
  const Triangulation& triangulation = complex.triangulation();
  Tetrahedra made;
  std::map<std::pair<Triangulation::Vertex_handle, std::array<int, 3>>, uint32_t> numbers;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<uint32_t, 4> nodes{};
    for (int n = 0; n < 4; ++n) {
      const auto offset = triangulation.int_to_off(cell->offset(n));
      const std::array<int, 3> periods{offset.x(), offset.y(), offset.z()};
      const auto next = static_cast<uint32_t>(made.points.size());
      const auto [number, is_new] = numbers.try_emplace({cell->vertex(n), periods}, next);
      if (is_new)
        made.points.push_back(vec(triangulation.construct_point(triangulation.point(cell->vertex(n)), offset)));
      nodes[static_cast<size_t>(n)] = number->second;
    }
    made.nodes.push_back(nodes);
    made.regions.push_back(static_cast<uint32_t>(complex.subdomain_index(cell)));
  }
  put_in_order(made);
  return made;
}

}  // namespace

Tetrahedra make_periodic(const TetrahedraRequest& request) {
  namespace params = CGAL::parameters;
  refuse_other_than_cubes(request.box);
  CGAL::get_default_random() = CGAL::Random(0);
  CGAL::Random random(0);
  const Box& box = request.box;
  const Geometry::Iso_cuboid_3 cell(Point(box.lo.x, box.lo.y, box.lo.z), Point(box.hi.x, box.hi.y, box.hi.z));
  constexpr double wanted = sliver_degrees.back();
  Questions questions;
  const auto region = [&](const Point& p) {
    questions.count();
    return static_cast<int>(request.region(wrapped(vec(p), box)));
  };
  const Domain domain(params::function = region, params::bounding_object = cell, params::p_rng = &random,
                      params::relative_error_bound = surface_error * request.least_size_mm / length(box.size()));
  const Sizing facets{&request, facet_share}, cells{&request, cell_share}, distance{&request, request.distance_share};
  const Criteria criteria(params::facet_angle = least_angle, params::facet_size = facets,
                          params::facet_distance = distance, params::cell_radius_edge_ratio = most_radius_to_edge,
                          params::cell_size = cells);
  const auto make = [&](bool mend) {
    questions.allow(request.most_questions);
    Complex complex = CGAL::make_periodic_3_mesh_3<Complex>(domain, criteria, params::no_features(), params::no_lloyd(),
                                                            params::no_odt(), params::no_perturb(), params::no_exude());
    questions.allow(questions_to_mend + questions_to_mend_of_cell * complex.number_of_cells());
    if (mend) CGAL::perturb_periodic_3_mesh_3(complex, domain, params::time_limit = 0, params::sliver_bound = wanted);
    questions.allow_all();
    CGAL::exude_periodic_3_mesh_3(complex, params::time_limit = 0, params::sliver_bound = wanted);
    return in_order(complex);
  };
  try {
    return make(true);
  } catch (const Questions::Enough&) {
  }
  // If mending exceeds its limit, the mesh is lost and made again without mending, with its slivers.
  try {
    return make(false);
  } catch (const Questions::Enough&) {
    throw Error(
        Code::not_meshed,
        "the tetrahedra become far too many and too small: sharp edges may lie too close together for this size");
  }
}

}  // namespace ombre::solids
