// Operations on children: groups, booleans, hulls, extrusions.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/vectors.h"

namespace ombre::lang::openscad {
namespace {

using solids::TreePtr;

template <class Operation>
TreePtr plain(ModuleCall& call) {
  return call.with_children(Operation{});
}

TreePtr minkowski(ModuleCall& call) {
  return call.with_children(solids::Minkowski{whole(call.number("convexity", 0))});
}

TreePtr render(ModuleCall& call) { return call.with_children(solids::Union{whole(call.number("convexity", 1))}); }

TreePtr resize(ModuleCall& call) {
  solids::Resize result;
  if (const List* size = call["newsize"].list())
    for (size_t i = 0; i < std::min<size_t>(3, size->items.size()); ++i)
      if (size->items[i].number()) result.size[static_cast<int>(i)] = *size->items[i].number();
  if (const List* each = call["auto"].list()) {
    for (size_t i = 0; i < std::min<size_t>(3, each->items.size()); ++i) result.automatic[i] = is_true(each->items[i]);
  } else {
    result.automatic.fill(call.flag("auto", false));
  }
  result.convexity = whole(call.number("convexity", 0));
  return call.with_children(result);
}

TreePtr offset(ModuleCall& call) {
  solids::Offset result{1, true, false, call.fragments()};
  if (const auto radius = call.number("r")) {
    result.distance = *radius;
  } else if (const auto delta = call.number("delta")) {
    result = {*delta, false, call.flag("chamfer", false), call.fragments()};
  }
  return call.with_children(result);
}

TreePtr projection(ModuleCall& call) {
  return call.with_children(solids::Projection{call.flag("cut", false), whole(call.number("convexity", 0))});
}

// Warns of an `origin` and a `scale` that are no finite numbers. As in OpenSCAD, the scale is judged beside an origin
// alone.
void check_numbers(const ModuleCall& call) {
  if (!call.has("origin")) return;
  check_origin(call, call.name());
  const auto each = numbers<2>(call["scale"]);
  const bool is_pair = each && std::isfinite((*each)[0]) && std::isfinite((*each)[1]);
  if (!is_pair && !std::isfinite(call.number("scale", std::numeric_limits<double>::quiet_NaN())))
    call.warn(call.name() + "(..., scale=" + call.shown("scale") + ") could not be converted");
}

// Extrudes the children, or the area in a file, which older scripts name instead of a child.
TreePtr extruded(ModuleCall& call, solids::Operation operation) {
  if (!call["file"].text()) return call.with_children(std::move(operation));
  const std::string name = call.name().starts_with("dxf_") ? call.name().substr(4) : call.name();
  call.deprecate("Support for reading files in " + name +
                 " will be removed in future releases. Use a child import() instead.");
  solids::Import file;
  file.path = call.complete_path(call.text("file"));
  file.layer = call.text("layer");
  file.fragments = call.fragments();
  if (const auto origin = numbers<2>(call["origin"])) file.origin = {(*origin)[0], (*origin)[1]};
  const auto result = call.node(std::move(operation));
  result->children.push_back(call.node(std::move(file)));
  return result;
}

double finite(double number, double otherwise) { return std::isfinite(number) ? number : otherwise; }

TreePtr linear_extrude(ModuleCall& call) {
  solids::LinearExtrude result;
  result.fragments = call.fragments();
  const auto first = call.number("file");  // linear_extrude(10)
  result.height = std::max(0.0, finite(call.number("height", first.value_or(100)), 100));
  if (const auto direction = vector3(call["v"], 0); direction && length(*direction) > 0) {
    result.direction = *direction;
    if (!call.has("height") && !first) result.height = length(*direction);
  }
  result.centred = call.flag("center", false);
  if (const auto all = call.number("scale"))
    result.scale = {*all, *all};
  else if (const auto each = numbers<2>(call["scale"]))
    result.scale = {(*each)[0], (*each)[1]};
  result.scale = {std::max(0.0, finite(result.scale.x, 1)), std::max(0.0, finite(result.scale.y, 1))};
  result.twist = finite(call.number("twist", 0), 0);
  if (const auto slices = call.number("slices"); slices && std::isfinite(*slices) && *slices >= 1)
    result.slices = whole(*slices);
  if (const auto segments = call.number("segments")) result.segments = std::max(0, whole(*segments));
  result.convexity = std::max(1, whole(call.number("convexity", 1)));
  check_numbers(call);
  return extruded(call, result);
}

TreePtr rotate_extrude(ModuleCall& call) {
  solids::RotateExtrude result;
  result.fragments = call.fragments();
  const double angle = call.number("angle", call.number("file", 360));
  if (std::isfinite(angle) && std::abs(angle) <= 360) result.angle = angle;
  result.start = call.number("start");
  result.convexity = std::max(2, whole(call.number("convexity", 2)));
  check_origin(call, call.name());
  return extruded(call, result);
}

TreePtr roof(ModuleCall& call) {
  solids::Roof result{solids::RoofMethod::distance, std::max(1, whole(call.number("convexity", 1))), call.fragments()};
  const std::string method = call.text("method", "voronoi");
  if (method == "straight")
    result.method = solids::RoofMethod::straight;
  else if (method != "voronoi")
    call.warn("Unknown roof method '" + method + "'. Using 'voronoi'.");
  return call.with_children(result);
}

// A module of old scripts, whose name has the prefix "dxf_".
template <TreePtr (*extrude)(ModuleCall& call)>
TreePtr old(ModuleCall& call) {
  call.deprecate_here("The " + call.name() + "() module will be removed in future releases. Use " +
                      call.name().substr(4) + "() instead.");
  return extrude(call);
}

}  // namespace

std::vector<Module> operation_modules() {
  const Module linear{"linear_extrude",
                      {"file", "layer", "height", "origin", "scale", "center", "twist", "slices"},
                      {"convexity", "v", "segments"},
                      linear_extrude};
  const Module turned{
      "rotate_extrude", {"file", "layer", "origin", "scale"}, {"convexity", "angle", "start"}, rotate_extrude};
  return {{"group", {}, {}, plain<solids::Group>, true},
          {"union", {}, {}, plain<solids::Union>, true},
          {"difference", {}, {}, plain<solids::Difference>, true},
          {"intersection", {}, {}, plain<solids::Intersection>, true},
          {"hull", {}, {}, plain<solids::Hull>},
          {"fill", {}, {}, plain<solids::Fill>},
          {"minkowski", {"convexity"}, {}, minkowski},
          {"render", {"convexity"}, {}, render},
          {"resize", {"newsize", "auto", "convexity"}, {}, resize},
          {"offset", {"r"}, {"delta", "chamfer"}, offset},
          {"projection", {"cut"}, {"convexity"}, projection},
          {"roof", {"method"}, {"convexity"}, roof},
          linear,
          {"dxf_linear_extrude", linear.positional, linear.named, old<linear_extrude>},
          turned,
          {"dxf_rotate_extrude", turned.positional, turned.named, old<rotate_extrude>}};
}

}  // namespace ombre::lang::openscad
