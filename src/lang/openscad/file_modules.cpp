// Modules that read geometry from files.
#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"
#include "lang/openscad/vectors.h"

namespace ombre::lang::openscad {
namespace {

using solids::TreePtr;

std::string given_path(const ModuleCall& call) {
  const std::string_view parameter = call.has("file") ? "file" : "filename";
  if (!call.has(parameter)) return "";
  return call[parameter].text() ? call[parameter].text()->text : call.shown(parameter);
}

TreePtr import_file(ModuleCall& call) {
  solids::Import result;
  result.path = call.complete_path(given_path(call));
  result.layer = call.text(call.has("layer") ? "layer" : "layername");
  result.id = call.text("id");
  check_origin(call, "linear_extrude");  // OpenSCAD names this module
  if (const auto origin = numbers<2>(call["origin"])) result.origin = {(*origin)[0], (*origin)[1]};
  result.scale = call.number("scale", 1);
  if (!(result.scale > 0)) result.scale = 1;
  result.dots_per_inch = call.number("dpi", 72);
  if (!(result.dots_per_inch > 0.001)) {
    call.warn("Invalid dpi value giving, using default of 72 dpi. Value must be positive and >= 0.001, file: \"" +
              given_path(call) + '"');
    result.dots_per_inch = 72;
  }
  result.centred = call.flag("center", false);
  result.is_painted = call.flag("strokes", false);  // OpenSCAD 2021.01 has no such parameter
  result.convexity = std::max(1, whole(call.number("convexity", 1)));
  result.fragments = call.fragments();
  return call.node(std::move(result));
}

// Imports a file for import_stl and similar modules of old scripts.
TreePtr import_old(ModuleCall& call) {
  call.deprecate_here("The " + call.name() + "() module will be removed in future releases. Use import() instead.");
  return import_file(call);
}

TreePtr surface(ModuleCall& call) {
  return call.node(
      solids::Surface{call.complete_path(given_path(call)), call.flag("center", false), call.flag("invert", false)});
}

}  // namespace

void check_origin(const ModuleCall& call, const std::string& module) {
  const auto origin = numbers<2>(call["origin"]);
  const bool is_pair = origin && std::isfinite((*origin)[0]) && std::isfinite((*origin)[1]);
  if (call.has("origin") && !is_pair)
    call.warn(module + "(..., origin=" + call.shown("origin") + ") could not be converted");
}

std::vector<Module> file_modules() {
  const std::vector<std::string_view> positional{"file", "layer", "convexity", "origin", "scale"};
  const std::vector<std::string_view> named{"width",  "height", "filename", "layername",
                                            "center", "dpi",    "id",       "strokes"};
  return {{"import", positional, named, import_file},
          {"import_stl", positional, named, import_old},
          {"import_off", positional, named, import_old},
          {"import_dxf", positional, named, import_old},
          {"surface", {"file", "center", "convexity"}, {"invert"}, surface}};
}

}  // namespace ombre::lang::openscad
