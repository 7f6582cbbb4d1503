// A design's distance and fractions as a program of numbers.
#include "compile/field_program.h"

#include <algorithm>

#include "compile/build.h"
#include "design/lowering.h"
#include "program/passes/passes.h"

namespace ombre::compile {
namespace {

using program::Field;

Field cut_off(Field distance, double band_mm) {
  const Field band = distance.builder->constant(band_mm), below = distance.builder->constant(-band_mm);
  return max(min(distance, band), below);
}

}  // namespace

std::vector<std::pair<MaterialId, Field>> shares(const design::Composition& composition) {
  std::vector<std::pair<MaterialId, Field>> parts;
  std::vector<Field> all;
  for (const auto& [id, fraction] : composition.fractions) {
    parts.emplace_back(id, max(fraction, 0.0));
    all.push_back(parts.back().second);
  }
  const Field total = program::fold(all, [](Field a, Field b) { return a + b; });
  for (auto& [id, part] : parts) part = share(part, total);
  return parts;
}

std::optional<program::Program> build_field_program(const design::Design& design, const FieldWishes& wishes,
                                                    Diagnostics& diagnostics) {
  const design::NodePtr solid = whole_solid(design);
  design::LoweringContext context(design.materials, {solid}, design.voxel_mm());
  program::Builder builder;
  design::Lowering lowering(context, builder);
  const program::Point p = program::Point::origin_frame(builder);

  std::vector<std::pair<std::string, Field>> outputs;
  if (wishes.distance) {
    const Field distance = lowering.distance(*solid, p);
    outputs.emplace_back("distance", wishes.band_mm ? cut_off(distance, *wishes.band_mm) : distance);
  }
  if (!wishes.fractions.empty()) {
    const Field inside = lowering.inside(*solid, p), none = builder.constant(0);
    for (const auto& [id, part] : shares(lowering.composition(*solid, p, design::Demand::inside)))
      if (std::find(wishes.fractions.begin(), wishes.fractions.end(), id) != wishes.fractions.end())
        outputs.emplace_back(design.materials.all()[id].name, select(inside, part, none));
  }
  context.finish_bodies();
  return flatten(builder.finish(outputs), solid->where(), diagnostics);
}

}  // namespace ombre::compile
