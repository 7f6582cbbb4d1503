// Solids without children.

#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/text_parameters.h"
#include "lang/openscad/vectors.h"

namespace ombre::lang::openscad {
namespace {

using solids::TreePtr;

TreePtr cube(ModuleCall& call) {
  solids::Cube result;
  if (call.has("size")) {
    const auto side = call.number("size");
    if (side) result.size = {*side, *side, *side};
    if (!side && !set_parts(call["size"], result.size))
      call.warn("Unable to convert cube(size=" + call.shown("size") +
                ", ...) parameter to a number or a vec3 of numbers");
  }
  result.centred = call.flag("center", false);
  (void)call.checked_fragments();  // adds warnings about them
  return call.node(result);
}

// Returns `r`, or half of `d`.
std::optional<double> radius(const ModuleCall& call, std::string_view r, std::string_view d) {
  const auto diameter = call.number(d);
  if (!diameter) return call.number(r);
  if (call.has(r))
    call.warn("Ignoring radius variable '" + std::string(r) + "' as diameter '" + std::string(d) + "' is defined too.");
  return *diameter / 2;
}

TreePtr sphere(ModuleCall& call) {
  const solids::Fragments fragments = call.checked_fragments();
  return call.node(solids::Sphere{radius(call, "r", "d").value_or(1), fragments});
}

TreePtr circle(ModuleCall& call) {
  const solids::Fragments fragments = call.checked_fragments();
  return call.node(solids::Circle{radius(call, "r", "d").value_or(1), fragments});
}

TreePtr cylinder(ModuleCall& call) {
  solids::Cylinder result;
  result.fragments = call.checked_fragments();
  result.height = call.number("h", 1);
  const auto both = radius(call, "r", "d"), bottom = radius(call, "r1", "d1"), top = radius(call, "r2", "d2");
  if (both && (bottom || top)) call.warn("Cylinder parameters ambiguous");
  result.bottom_radius = bottom.value_or(both.value_or(1));
  result.top_radius = top.value_or(both.value_or(1));
  result.centred = call.flag("center", false);
  return call.node(result);
}

// Reads lists of point indices, and leaves out invalid ones.
std::vector<std::vector<size_t>> index_lists(const Value& value) {
  std::vector<std::vector<size_t>> lists;
  if (!value.list()) return lists;
  for (const Value& item : value.list()->items) {
    if (!item.list()) continue;
    std::vector<size_t>& indices = lists.emplace_back();
    for (const Value& index : item.list()->items)
      if (index.number() && *index.number() >= 0 && *index.number() < 1e9)
        indices.push_back(static_cast<size_t>(*index.number()));
  }
  return lists;
}

// Reads points of two or three coordinates.
std::vector<Vec3> points_of(const ModuleCall& call, const std::string& kind,
                            std::optional<solids::WrongPoints>& wrong) {
  std::vector<Vec3> points;
  if (!call["points"].list()) return points;
  for (const Value& item : call["points"].list()->items) {
    const auto point = vector3(item, 0);
    if (!point && !wrong)
      wrong = {"Unable to convert points[" + std::to_string(points.size()) + "] = " + call.shown_value(item) +
                   " to a " + kind + " of numbers",
               call.shown("points")};
    points.push_back(point.value_or(Vec3{}));
  }
  return points;
}

TreePtr polyhedron(ModuleCall& call) {
  solids::Polyhedron result;
  (void)call.checked_fragments();
  result.points = points_of(call, "vec3", result.wrong);
  const bool is_old = call.has("triangles") && !call.has("faces");
  if (is_old)
    call.deprecate("polyhedron(triangles=[]) will be removed in future releases. Use polyhedron(faces=[]) instead.");
  result.faces = index_lists(call[is_old ? "triangles" : "faces"]);
  result.convexity = whole(call.number("convexity", 1));
  return call.node(std::move(result));
}

TreePtr square(ModuleCall& call) {
  solids::Square result;
  (void)call.checked_fragments();
  if (call.has("size")) {
    const auto two = numbers<2>(call["size"]);
    if (const auto side = call.number("size"))
      result.size = {*side, *side};
    else if (two)
      result.size = {(*two)[0], (*two)[1]};
    else
      call.warn("Unable to convert square(size=" + call.shown("size") +
                ", ...) parameter to a number or a vec2 of numbers");
  }
  result.centred = call.flag("center", false);
  return call.node(result);
}

TreePtr polygon(ModuleCall& call) {
  solids::Polygon result;
  (void)call.checked_fragments();
  for (const Vec3 point : points_of(call, "vec2", result.wrong)) result.points.push_back({point.x, point.y});
  result.paths = index_lists(call["paths"]);
  result.convexity = whole(call.number("convexity", 1));
  return call.node(std::move(result));
}

TreePtr text(ModuleCall& call) {
  solids::Text result = text_of(call);
  result.fragments = call.fragments();
  return call.node(std::move(result));
}

}  // namespace

std::vector<Module> shape_modules() {
  return {{"cube", {"size", "center"}, {}, cube},
          {"sphere", {"r"}, {"d"}, sphere},
          {"cylinder", {"h", "r1", "r2", "center"}, {"r", "d", "d1", "d2"}, cylinder},
          {"polyhedron", {"points", "faces", "convexity"}, {"triangles"}, polyhedron}};
}

std::vector<Module> plane_modules() {
  return {{"square", {"size", "center"}, {}, square},
          {"circle", {"r"}, {"d"}, circle},
          {"polygon", {"points", "paths", "convexity"}, {}, polygon},
          {"text", {"text", "size", "font"}, {"direction", "language", "script", "halign", "valign", "spacing"}, text}};
}

}  // namespace ombre::lang::openscad
