// Builtin functions of points in space.
#include <cmath>

#include "base/math/point_sets.h"
#include "lang/engine/builtins.h"

namespace ombre::lang {
namespace {

Vec3 point_argument(const BuiltinCall& call, size_t i, const Value& value, const std::string& what) {
  const List* list = value.list();
  Vec3 p;
  bool is_good = list && list->items.size() == 3;
  for (size_t axis = 0; is_good && axis < 3; ++axis) {
    const double* number = list->items[axis].number();
    is_good = number && std::isfinite(*number);
    if (is_good) p[static_cast<int>(axis)] = *number;
  }
  if (!is_good) call.expected(i, what, "a point is three finite numbers: [x, y, z]");
  return p;
}

std::vector<Vec3> points_argument(const BuiltinCall& call) {
  const List& list = call.list(0);
  call.meter.spend(16 * list.items.size());  // the functions take longer than reading the points
  std::vector<Vec3> points;
  points.reserve(list.items.size());
  for (const Value& item : list.items) points.push_back(point_argument(call, 0, item, "a list of points"));
  return points;
}

Value point_value(const BuiltinCall& call, Vec3 p) { return make_list({p.x, p.y, p.z}, call.meter); }

Value edges_value(const BuiltinCall& call, const OfPoints<Edge3>& edges) {
  if (!edges.problem.empty()) throw BadArgument{0, std::string(call.name()) + "(): " + edges.problem, ""};
  ListBuilder result(call.meter);
  for (const auto& [from, to] : edges.list) {
    ListBuilder edge(call.meter);
    edge.push(point_value(call, from));
    edge.push(point_value(call, to));
    result.push(edge.finish());
  }
  return result.finish();
}

Value delaunay(const BuiltinCall& call) { return edges_value(call, delaunay_edges(points_argument(call))); }

Value voronoi(const BuiltinCall& call) {
  const std::vector<Vec3> points = points_argument(call);
  if (!call.has(1) && !call.has(2)) return edges_value(call, voronoi_edges(points, std::nullopt));
  if (!call.has(1) || !call.has(2)) call.expected(call.has(1) ? 2 : 1, "both corners of a box, or none");
  const Box box{point_argument(call, 1, call[1], "the lower corner of a box"),
                point_argument(call, 2, call[2], "the upper corner of a box")};
  if (box.is_empty()) call.expected(2, "an upper corner that is nowhere below the lower one");
  return edges_value(call, voronoi_edges(points, box));
}

}  // namespace

std::vector<Builtin> point_builtins() {
  return {
      {"delaunay_edges", {"points"}, 1, false, delaunay},
      {"voronoi_edges", {"points", "min", "max"}, 1, false, voronoi},
  };
}

}  // namespace ombre::lang
