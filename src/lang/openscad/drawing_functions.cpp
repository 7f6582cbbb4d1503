// Functions that measure drawings.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "lang/openscad/script_functions.h"
#include "lang/openscad/value_text.h"
#include "lang/openscad/vectors.h"
#include "solids/drawing_measures.h"

namespace ombre::lang::openscad {
namespace {

// OpenSCAD takes named arguments only, and warns of others.
solids::MeasureChoice choice_of(const FunctionCall& call) {
  solids::MeasureChoice choice;
  const std::string function = std::string(call.name) + "(..., ";
  for (size_t n = 0; n < call.size(); ++n) {
    const Symbol symbol = call.written.arguments[n].name.symbol;
    const std::string name = symbol ? *symbol : "";
    const Text* text = call[n].text();
    if (name == "file") {
      choice.shown = text ? text->text : "";
      choice.path = path_beside(call.written.span, choice.shown);
    } else if (name == "layer" || name == "name") {
      (name == "layer" ? choice.layer : choice.name) = text ? text->text : "";
    } else if (name == "origin") {
      const auto origin = numbers<2>(call[n]);
      if (origin && std::isfinite((*origin)[0]) && std::isfinite((*origin)[1]))
        choice.origin = {(*origin)[0], (*origin)[1]};
      else
        call.fail(function + "origin=" + value_text(call[n], true, call.meter) + ") could not be converted");
    } else if (name == "scale") {
      if (const double* scale = call[n].number()) choice.scale = *scale;
    } else {
      call.fail(function + name + "=...) is not supported");
    }
  }
  return choice;
}

// Warns of entities that OpenSCAD 2021.01 does not support.
void tell_of_others(const FunctionCall& call, const solids::MeasureChoice& choice,
                    const std::map<std::string, size_t>& others) {
  constexpr std::array<std::string_view, 5> supported{"CIRCLE", "ARC", "ELLIPSE", "LWPOLYLINE", "INSERT"};
  for (const auto& [kind, count] : others)
    if (std::ranges::find(supported, kind) == supported.end())
      call.note("Unsupported DXF Entity '" + kind + "' (" + std::to_string(count) + ") in \"" +
                std::filesystem::path(choice.path).filename().string() + "\".");
}

Value dxf_dim(const FunctionCall& call) {
  const solids::MeasureChoice choice = choice_of(call);
  const auto found = solids::dimension_of(choice);
  tell_of_others(call, choice, found.others);
  return found.value ? Value(*found.value) : call.fail(found.warning);
}

Value dxf_cross(const FunctionCall& call) {
  const solids::MeasureChoice choice = choice_of(call);
  const auto found = solids::crossing_of(choice);
  tell_of_others(call, choice, found.others);
  if (!found.value) return call.fail(found.warning);
  return make_list({found.value->x, found.value->y}, call.meter);
}

}  // namespace

std::vector<NamedFunction> drawing_functions() { return {{"dxf_dim", dxf_dim}, {"dxf_cross", dxf_cross}}; }

}  // namespace ombre::lang::openscad
