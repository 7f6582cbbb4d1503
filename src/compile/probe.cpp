#include "compile/probe.h"

#include "compile/build.h"
#include "program/passes/passes.h"

namespace ombre::compile {
namespace {

// Outputs: inside and distance of the whole, fractions, attributes, then inside of each part.
struct ProbeProgram {
  program::Program program;
  std::vector<MaterialId> materials;
  std::vector<std::string> attributes;
};

ProbeProgram build(const design::Design& design) {
  const design::NodePtr solid = whole_solid(design);
  std::vector<design::NodePtr> roots = design.roots();
  roots.push_back(solid);
  design::LoweringContext context(design.materials, roots);
  program::Builder builder;
  design::Lowering lowering(context, builder);
  const program::Point p = program::Point::origin_frame(builder);
  ProbeProgram result;
  std::vector<std::pair<std::string, program::Field>> outputs{{"inside", lowering.inside(*solid, p)},
                                                              {"distance", lowering.distance(*solid, p)}};
  for (const auto& [id, fraction] : lowering.composition(*solid, p, design::Demand::inside).fractions) {
    outputs.emplace_back(design.materials.all()[id].name, fraction);
    result.materials.push_back(id);
  }
  for (const auto& attribute : context.attributes()) {
    outputs.emplace_back(attribute.name, lowering.attribute(*solid, attribute.name, p, design::Demand::inside));
    result.attributes.push_back(attribute.name);
  }
  for (const design::Part& part : design.parts) outputs.emplace_back(part.name, lowering.inside(*part.solid, p));
  context.finish_bodies();
  result.program = program::inline_bodies(builder.finish(outputs));
  return result;
}

// The program with those of many parts written out that reach the point.
program::Program parts_at(const program::Program& program, Vec3 point) {
  if (!program.has_parts()) return program;
  std::vector<Interval> ranges;
  program::evaluate_intervals(program, {point, point}, ranges);
  return program::expand_parts(program, ranges, program::Precision::reference);
}

}  // namespace

std::optional<std::vector<ProbeResult>> probe(const Loaded& loaded, const std::vector<Vec3>& points,
                                              Diagnostics& diagnostics) {
  const design::Design& design = loaded.design;
  if (!build_flat_program(design, diagnostics)) return std::nullopt;
  const ProbeProgram built = build(design);
  std::vector<ProbeResult> results;
  std::vector<double> values;
  for (const Vec3 point : points) {
    const program::Program here = parts_at(built.program, point);
    program::evaluate_point(here, point, values);
    size_t next = 0;
    const auto output = [&] { return values[here.outputs[next++]]; };
    ProbeResult result;
    result.point = point;
    result.inside = output() != 0;
    result.distance = output();
    for (const MaterialId id : built.materials)
      if (const double fraction = output(); result.inside && fraction > 0)
        result.composition.emplace_back(design.materials.all()[id].name, fraction);
    for (const std::string& name : built.attributes) result.attributes.emplace_back(name, output());
    for (const design::Part& part : design.parts)
      if (output() != 0) result.parts.push_back(part.name);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace ombre::compile
