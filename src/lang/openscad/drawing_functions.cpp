// Functions that measure drawings.
#include <array>

#include "lang/openscad/script_functions.h"
#include "lang/openscad/vectors.h"
#include "solids/drawing_measures.h"

namespace ombre::lang::openscad {
namespace {

// Positional arguments come in this order.
solids::MeasureChoice choice_of(const FunctionCall& call) {
  constexpr std::array<std::string_view, 5> order{"file", "layer", "name", "origin", "scale"};
  solids::MeasureChoice choice;
  for (size_t n = 0; n < call.size() && n < order.size(); ++n) {
    const std::string name =
        call.written.arguments[n].name.symbol ? *call.written.arguments[n].name.symbol : std::string(order[n]);
    const Text* text = call[n].text();
    if (name == "file" && text) choice.path = path_beside(call.written.span, text->text);
    if (name == "layer" && text) choice.layer = text->text;
    if (name == "name" && text) choice.name = text->text;
    if (const auto origin = numbers<2>(call[n]); name == "origin" && origin)
      choice.origin = {(*origin)[0], (*origin)[1]};
    if (name == "scale" && call[n].number()) choice.scale = *call[n].number();
  }
  return choice;
}

Value dxf_dim(const FunctionCall& call) {
  const auto found = solids::dimension_of(choice_of(call));
  return found.value ? Value(*found.value) : call.fail(found.warning);
}

Value dxf_cross(const FunctionCall& call) {
  const auto found = solids::crossing_of(choice_of(call));
  if (!found.value) return call.fail(found.warning);
  return make_list({found.value->x, found.value->y}, call.meter);
}

}  // namespace

std::vector<NamedFunction> drawing_functions() { return {{"dxf_dim", dxf_dim}, {"dxf_cross", dxf_cross}}; }

}  // namespace ombre::lang::openscad
