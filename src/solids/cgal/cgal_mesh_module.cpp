// Tetrahedral meshes by CGAL's Mesh_3.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/exude_mesh_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>

#include <algorithm>
#include <map>

#include "base/text/error.h"
#include "solids/mesh_module.h"

namespace ombre::solids {
namespace {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Geometry::Point_3;

// Limits on the number of balls around points of a sharp edge: in total, and per wanted size along it.
constexpr double most_balls = 2000, most_balls_of_size = 50;
// If refinement does not end, sharp edges with at least this many balls per wanted size along them are dropped.
constexpr double crowded_balls_of_size = 8;

// Sharp edges for which refinement does not end.
struct EndlessEdges {
  std::vector<size_t> lines;  // ascending
};

// Counts the balls that protect sharp edges. Where such edges are close together or cross, balls become ever smaller.
class Domain : public CGAL::Mesh_domain_with_polyline_features_3<CGAL::Labeled_mesh_domain_3<Geometry>> {
 public:
  using Base = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Labeled_mesh_domain_3<Geometry>>;
  using Base::Base;

  // Sets the number of balls that each line would have if each ball had the wanted size.
  void expect_balls(std::vector<double> of_line) {
    expected_ = std::move(of_line);
    count_.assign(expected_.size(), 0);
  }

  Point construct_point_on_curve(const Point& from, const Curve_index& curve, FT distance) const {
    count_ball(curve);
    return Base::construct_point_on_curve(from, curve, distance);
  }
  void count_ball(const Curve_index& curve) const {
    const auto line = static_cast<size_t>(curve) - 1;
    if (static_cast<double>(++count_[line]) > most_balls + most_balls_of_size * expected_[line])
      throw EndlessEdges{{line}};
  }

  // Returns the lines with the most balls for their length; at least one.
  std::vector<size_t> crowded_lines() const {
    const auto crowd = [&](size_t line) { return static_cast<double>(count_[line]) / (1 + expected_[line]); };
    double most = 0;
    for (size_t line = 0; line < count_.size(); ++line) most = std::max(most, crowd(line));
    std::vector<size_t> found;
    for (size_t line = 0; line < count_.size(); ++line)
      if (crowd(line) >= std::min(most, crowded_balls_of_size)) found.push_back(line);
    return found;
  }

 private:
  std::vector<double> expected_;
  mutable std::vector<uint64_t> count_;
};
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Usual = CGAL::Mesh_criteria_3<Triangulation>;

// Greatest distance of edges from sharp edges, as a share of the element size.
constexpr double edge_distance_share = 0.03;
// Greatest distance of facets from the surface next to dropped sharp edges, as a share of the element size.
constexpr double rough_distance_share = 0.2;
constexpr int most_attempts = 8;  // attempts to find the edges to drop

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

double distance_to_segment(Vec3 at, Vec3 from, Vec3 to) {
  const Vec3 along = to - from;
  const double share = std::clamp(dot(at - from, along) / dot(along, along), 0.0, 1.0);
  return length(at - from - share * along);
}

// Length in sizes: facets and cells with a shorter edge are not refined. Otherwise refinement would not end where
// surfaces meet in a sharp angle that is not a protected edge.
constexpr double least_edge = 0.03;

// A position-dependent size, in the form that CGAL's criteria require.
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

// The greatest distance of facets from the surface. It is larger next to dropped sharp edges, where facets would
// otherwise be refined without end.
struct DistanceSizing {
  using FT = Geometry::FT;
  using Point_3 = Point;
  const TetrahedraRequest* request;
  const std::vector<Polyline>* left_out;
  template <class P, class Index>
  FT operator()(const P& p, int /*dimension*/, const Index& /*index*/) const {
    const Vec3 at = {p.x(), p.y(), p.z()};
    const double size = request->size_mm(at);
    const auto is_near = [&](const Polyline& line) {
      for (size_t n = 0; n + 1 < line.size(); ++n)
        if (distance_to_segment(at, line[n], line[n + 1]) < size) return true;
      return false;
    };
    const bool is_rough = std::any_of(left_out->begin(), left_out->end(), is_near);
    return size * std::max(request->distance_share, is_rough ? rough_distance_share : 0);
  }
};

// The size along sharp edges, where the balls must also follow bends.
struct EdgeSizing {
  using FT = Geometry::FT;
  using Point_3 = Point;
  const Domain* domain;
  const TetrahedraRequest* request;
  const std::vector<std::vector<double>>* longest_mm;  // longest chords, for each point of each line
  template <class P, class Index>
  FT operator()(const P& p, int dimension, const Index& index) const {
    const Vec3 at = {p.x(), p.y(), p.z()};
    const double size = request->size_mm(at);
    if (dimension != 1) return std::min(size, at_corner(at));
    domain->count_ball(domain->curve_index(index));
    const auto line = static_cast<size_t>(domain->curve_index(index)) - 1;
    return std::min(size, on_line(at, request->sharp_edges[line], (*longest_mm)[line]));
  }

  double at_corner(Vec3 at) const {
    double least = std::numeric_limits<double>::infinity();
    for (size_t line = 0; line < request->sharp_edges.size(); ++line) {
      if (request->sharp_edges[line].front() == at) least = std::min(least, (*longest_mm)[line].front());
      if (request->sharp_edges[line].back() == at) least = std::min(least, (*longest_mm)[line].back());
    }
    return least;
  }

  static double on_line(Vec3 at, const Polyline& line, const std::vector<double>& longest_mm) {
    double nearest = std::numeric_limits<double>::infinity(), found = nearest;
    for (size_t n = 0; n + 1 < line.size(); ++n) {
      const double off = distance_to_segment(at, line[n], line[n + 1]);
      if (off < nearest) nearest = off, found = std::min(longest_mm[n], longest_mm[n + 1]);
    }
    return found;
  }
};

// Returns the greatest length of a chord from a point of a line in one direction, such that the line stays within
// `most_off_mm` of it.
double longest_chord(const Polyline& line, size_t from, ptrdiff_t step, double most_off_mm) {
  const auto is_on = [&](ptrdiff_t n) { return n >= 0 && n < static_cast<ptrdiff_t>(line.size()); };
  const auto point = [&](ptrdiff_t n) { return line[static_cast<size_t>(n)]; };
  double reached = std::numeric_limits<double>::infinity();
  const auto begin = static_cast<ptrdiff_t>(from);
  for (ptrdiff_t end = begin + step; is_on(end); end += step) {
    const Vec3 chord = point(end) - point(begin);
    for (ptrdiff_t n = begin + step; n != end; n += step) {
      const Vec3 away = point(n) - point(begin);
      const double share = dot(chord, chord) > 0 ? std::clamp(dot(away, chord) / dot(chord, chord), 0.0, 1.0) : 0;
      if (length(away - share * chord) > most_off_mm) return reached;
    }
    reached = length(chord);
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<double> longest_chords(const Polyline& line, const std::function<double(Vec3)>& size_mm) {
  std::vector<double> found;
  for (size_t n = 0; n < line.size(); ++n) {
    const double most_off = edge_distance_share * size_mm(line[n]);
    found.push_back(std::min(longest_chord(line, n, 1, most_off), longest_chord(line, n, -1, most_off)));
  }
  return found;
}

// Returns true if an edge between these corners of a cell is too short for its cell or facet to be refined.
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

// CGAL's usual criteria, but small facets are never bad.
struct LimitedFacets : Usual::Facet_criteria {
  using Base = Usual::Facet_criteria;
  const std::function<double(Vec3)>* size_mm;

  LimitedFacets(const Base& base, const std::function<double(Vec3)>& size) : Base(base), size_mm(&size) {}

  Is_facet_bad operator()(const Triangulation& triangulation, const Triangulation::Facet& facet) const {
    std::array<int, 3> corners{};
    for (int n = 0; n < 3; ++n) corners[static_cast<size_t>(n)] = (facet.second + n + 1) % 4;
    return is_small(triangulation, facet.first, corners, *size_mm) ? Is_facet_bad()
                                                                   : Base::operator()(triangulation, facet);
  }
};
struct LimitedCells : Usual::Cell_criteria {
  using Base = Usual::Cell_criteria;
  const std::function<double(Vec3)>* size_mm;

  LimitedCells(const Base& base, const std::function<double(Vec3)>& size) : Base(base), size_mm(&size) {}

  Is_cell_bad operator()(const Triangulation& triangulation, const Triangulation::Cell_handle& cell) const {
    const bool is_fine = is_small(triangulation, cell, std::array{0, 1, 2, 3}, *size_mm);
    return is_fine ? Is_cell_bad() : Base::operator()(triangulation, cell);
  }
};

class Criteria {
 public:
  using Edge_criteria = Usual::Edge_criteria;
  using Facet_criteria = LimitedFacets;
  using Cell_criteria = LimitedCells;

  Criteria(const Usual& usual, const std::function<double(Vec3)>& size_mm)
      : edges_(usual.edge_criteria_object()),
        facets_(usual.facet_criteria_object(), size_mm),
        cells_(usual.cell_criteria_object(), size_mm) {}

  const Edge_criteria& edge_criteria_object() const { return edges_; }
  const Facet_criteria& facet_criteria_object() const { return facets_; }
  const Cell_criteria& cell_criteria_object() const { return cells_; }

 private:
  Edge_criteria edges_;
  Facet_criteria facets_;
  Cell_criteria cells_;
};

Tetrahedra in_order(const Complex& complex) {
  const Triangulation& triangulation = complex.triangulation();
  Tetrahedra made;
  std::map<Triangulation::Vertex_handle, uint32_t> numbers;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<uint32_t, 4> nodes{};
    for (int n = 0; n < 4; ++n) {
      const auto [number, is_new] = numbers.emplace(cell->vertex(n), static_cast<uint32_t>(made.points.size()));
      if (is_new)
        made.points.push_back(
            vec(triangulation.geom_traits().construct_point_3_object()(triangulation.point(cell->vertex(n)))));
      nodes[static_cast<size_t>(n)] = number->second;
    }
    made.nodes.push_back(nodes);
    made.regions.push_back(static_cast<uint32_t>(complex.subdomain_index(cell)));
  }
  put_in_order(made);
  return made;
}

// Removes slivers, first by moving nodes, then by giving nodes weights. Some slivers between protected balls cannot be
// removed, and the randomized search for better places would take many minutes. So the number of queries for each
// wanted angle is limited; if that is exceeded, the mesh of the previous angle is kept. (CGAL's own limit is a time, so
// results would differ between runs; 0 disables it.)
void mend_slivers(const Domain& domain, Questions& questions, Complex& complex) {
  namespace params = CGAL::parameters;
  for (const double degrees : sliver_degrees) {
    Complex moved(complex);
    questions.allow(questions_to_mend + questions_to_mend_of_cell * complex.number_of_cells());
    try {
      CGAL::perturb_mesh_3(moved, domain, params::time_limit = 0, params::sliver_bound = degrees);
    } catch (const Questions::Enough&) {
      break;
    }
    complex = std::move(moved);
  }
  questions.allow_all();
  CGAL::exude_mesh_3(complex, params::time_limit = 0, params::sliver_bound = sliver_degrees.back());
}

double length_of(const Polyline& line) {
  double sum = 0;
  for (size_t n = 0; n + 1 < line.size(); ++n) sum += length(line[n + 1] - line[n]);
  return sum;
}

Tetrahedra make_with(const TetrahedraRequest& request, const std::vector<Polyline>& left_out) {
  namespace params = CGAL::parameters;
  CGAL::get_default_random() = CGAL::Random(0);
  CGAL::Random random(0);
  const Box& box = request.box;
  const Geometry::Iso_cuboid_3 around(Point(box.lo.x, box.lo.y, box.lo.z), Point(box.hi.x, box.hi.y, box.hi.z));
  Questions questions;
  const auto region = [&](const Point& p) {
    questions.count();
    return static_cast<int>(request.region(vec(p)));
  };
  Domain domain(params::function = region, params::bounding_object = around, params::p_rng = &random,
                params::relative_error_bound = surface_error * request.least_size_mm / length(box.size()));
  std::vector<std::vector<Point>> edges;
  std::vector<std::vector<double>> longest_mm;
  std::vector<double> balls;
  for (const Polyline& line : request.sharp_edges) {
    edges.emplace_back();
    for (const Vec3& p : line) edges.back().emplace_back(p.x, p.y, p.z);
    longest_mm.push_back(longest_chords(line, request.size_mm));
    balls.push_back(length_of(line) / request.least_size_mm);
  }
  domain.expect_balls(std::move(balls));
  domain.add_features(edges.begin(), edges.end());
  for (const Vec3& p : request.fixed_points) domain.add_corner(Point(p.x, p.y, p.z));
  const EdgeSizing edge{&domain, &request, &longest_mm};
  const Sizing facet{&request.size_mm, facet_share}, cell{&request.size_mm, cell_share};
  const DistanceSizing distance{&request, &left_out};
  const Usual usual(params::edge_size = edge, params::facet_angle = least_angle, params::facet_size = facet,
                    params::facet_distance = distance, params::cell_radius_edge_ratio = most_radius_to_edge,
                    params::cell_size = cell);
  const Criteria criteria(usual, request.size_mm);
  questions.allow(request.most_questions);
  const auto refine = [&] {
    return CGAL::make_mesh_3<Complex>(domain, criteria, params::features(domain), params::no_lloyd(), params::no_odt(),
                                      params::no_perturb(), params::no_exude());
  };
  Complex complex;
  try {
    complex = refine();
  } catch (const Questions::Enough&) {
    throw EndlessEdges{domain.crowded_lines()};
  }
  mend_slivers(domain, questions, complex);
  return in_order(complex);
}

// Repeats the meshing without the sharp edges for which it does not end.
Tetrahedra make(TetrahedraRequest request) {
  std::vector<Polyline> left_out;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    try {
      Tetrahedra made = make_with(request, left_out);
      made.edges_left_out = std::move(left_out);
      return made;
    } catch (const EndlessEdges& endless) {
      if (endless.lines.empty()) break;
      for (auto line = endless.lines.rbegin(); line != endless.lines.rend(); ++line) {
        const auto place = request.sharp_edges.begin() + static_cast<ptrdiff_t>(*line);
        left_out.push_back(std::move(*place));
        request.sharp_edges.erase(place);
      }
    }
  }
  throw Error(Code::not_meshed,
              "the tetrahedra become far too many and too small: sharp edges may lie too close together for this size");
}

}  // namespace
}  // namespace ombre::solids

extern "C" void ombre_make_tetrahedra(const ombre::solids::TetrahedraRequest& request,
                                      ombre::solids::Tetrahedra& made) {
  try {
    made = request.is_periodic ? ombre::solids::make_periodic(request) : ombre::solids::make(request);
  } catch (const ombre::Error&) {
    throw;
  } catch (const std::logic_error& failure) {
    throw ombre::Error(ombre::Code::not_meshed, std::string("the tetrahedra could not be made: ") + failure.what());
  }
}
