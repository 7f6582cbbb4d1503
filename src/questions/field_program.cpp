#include "questions/field_program.h"

#include <algorithm>

#include "questions/question.h"

namespace ombre::compile {
namespace {

using program::Field;

Field cut_off(Field distance, double band_mm) {
  const Field band = distance.builder->constant(band_mm), below = distance.builder->constant(-band_mm);
  return max(min(distance, band), below);
}

}  // namespace

std::optional<program::Program> build_field_program(const design::Design& design, const FieldQuery& query,
                                                    Diagnostics& diagnostics) {
  Question question(design);
  program::Outputs outputs;
  if (query.distance) {
    const Field distance = question.distance();
    outputs.emplace_back("distance", query.band_mm ? cut_off(distance, *query.band_mm) : distance);
  }
  if (!query.fractions.empty()) {
    const Field inside = question.inside(), none = question.builder().constant(0);
    for (const auto& [id, part] : shares(question.composition()))
      if (std::find(query.fractions.begin(), query.fractions.end(), id) != query.fractions.end())
        outputs.emplace_back(design.materials.all()[id].name, select(inside, part, none));
  }
  for (const std::string& name : query.attributes) {
    const auto value = question.attribute(name, diagnostics);
    if (!value) return std::nullopt;
    const Field usual = question.builder().constant(design::default_of(*question.declaration(name), name));
    outputs.emplace_back(name, select(question.inside(), *value, usual));
  }
  if (query.inside) outputs.emplace_back("inside", question.inside());
  return question.program(outputs, diagnostics);
}

}  // namespace ombre::compile
