// Finds edges at which the result of a boolean would touch itself. Corefinement of CGAL 5.5 makes no surface mesh
// there: it fails, or does not end.
#include "solids/cgal/cgal_boxes.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>

#include "solids/cgal/cgal_body.h"

namespace ombre::solids {
namespace {

using Point = Exact::Point_3;
using Side = ExactMesh::Halfedge_index;

struct Axis {
  Point from, to;

  // True if turning about the axis from the half-plane of `start` leads to that of `x` before that of `y`.
  bool comes_before(const Point& start, const Point& x, const Point& y) const {
    const int to_x = part_of_turn(from, to, start, x), to_y = part_of_turn(from, to, start, y);
    if (to_x != to_y) return to_x < to_y;
    return (to_x == 1 || to_x == 3) && part_of_turn(from, to, x, y) == 1;
  }
};

// The solid near one of its edges, between the half-planes of two points.
struct Wedge {
  Point begin, end;

  // True if the solid lies behind the half-plane of `x`, in the direction of turning.
  bool holds(const Axis& axis, const Point& x) const { return axis.comes_before(begin, x, end); }
};

Axis axis_of(const ExactMesh& mesh, Side side) {
  return {mesh.point(mesh.source(side)), mesh.point(mesh.target(side))};
}

// Faces look outward, so turning about the side from the face of the opposite side leads through the solid.
Wedge wedge_of(const ExactMesh& mesh, Side side) {
  const auto apex = [&](Side s) { return mesh.point(mesh.target(mesh.next(s))); };
  return {apex(mesh.opposite(side)), apex(side)};
}

bool is_in_result(Boolean operation, bool in_first, bool in_second) {
  switch (operation) {
    case Boolean::unite:
      return in_first || in_second;
    case Boolean::intersect:
      return in_first && in_second;
    case Boolean::subtract:
      return in_first && !in_second;
  }
  return false;
}

// True if the result has two wedges at the axis.
bool has_two_wedges(Boolean operation, const Axis& axis, const Wedge& first, const Wedge& second) {
  std::array<Point, 4> borders{first.begin, first.end, second.begin, second.end};
  std::sort(borders.begin() + 1, borders.end(),
            [&](const Point& x, const Point& y) { return axis.comes_before(borders[0], x, y); });
  const auto holds = [&](const Point& border) {
    return is_in_result(operation, first.holds(axis, border), second.holds(axis, border));
  };
  int changes = 0;
  bool last = holds(borders.back());
  for (const Point& border : borders) {
    const bool now = holds(border);
    if (now != last) ++changes;
    last = now;
  }
  return changes > 2;
}

// True if the edges have more than a point in common.
bool overlap(const Axis& a, const Axis& b) {
  if (!CGAL::collinear(a.from, a.to, b.from) || !CGAL::collinear(a.from, a.to, b.to)) return false;
  const auto [a_low, a_high] = std::minmax(a.from, a.to);
  const auto [b_low, b_high] = std::minmax(b.from, b.to);
  return std::max(a_low, b_low) < std::min(a_high, b_high);
}

bool have_one_direction(const Axis& a, const Axis& b) { return (a.from < a.to) == (b.from < b.to); }

using EdgeBox = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, Side, CGAL::Box_intersection_d::ID_EXPLICIT>;

std::vector<EdgeBox> edge_boxes(const ExactMesh& mesh) {
  std::vector<EdgeBox> boxes;
  for (const auto edge : mesh.edges()) {
    const Side side = mesh.halfedge(edge);
    boxes.emplace_back(mesh.point(mesh.source(side)).bbox() + mesh.point(mesh.target(side)).bbox(), side);
  }
  return boxes;
}

}  // namespace

int part_of_turn(const Point& a, const Point& b, const Point& c, const Point& d) {
  const CGAL::Orientation side = CGAL::orientation(a, b, c, d);
  if (side != CGAL::COPLANAR) return side == CGAL::POSITIVE ? 1 : 3;
  return CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE ? 0 : 2;
}

bool touches_itself_after(Boolean operation, const ExactMesh& first, const ExactMesh& second) {
  std::vector<EdgeBox> of_first = edge_boxes(first), of_second = edge_boxes(second);
  bool found = false;
  const auto compare = [&](const EdgeBox& a, const EdgeBox& b) {
    if (found) return;
    const Axis axis = axis_of(first, a.handle());
    const Axis other = axis_of(second, b.handle());
    if (!overlap(axis, other)) return;
    const Side side = have_one_direction(axis, other) ? b.handle() : second.opposite(b.handle());
    found = has_two_wedges(operation, axis, wedge_of(first, a.handle()), wedge_of(second, side));
  };
  CGAL::box_intersection_d(of_first.begin(), of_first.end(), of_second.begin(), of_second.end(), compare);
  return found;
}

}  // namespace ombre::solids
