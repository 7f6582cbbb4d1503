#include "compile/build.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "compile/possible_outputs.h"
#include "nodes/all_nodes.h"
#include "program/passes/passes.h"

namespace ombre::compile {
namespace {

constexpr double most_instructions = 1e8;  // some gigabytes

// Meshes and CAD solids may lie anywhere; designs end at a limit. True, and a diagnostic, where a solid ends beyond it.
bool report_beyond_limit(const design::Node& solid, Diagnostics& diagnostics) {
  constexpr double wide_mm = 1e12;
  const Box bounds = solid.bounds(Box::centered({wide_mm, wide_mm, wide_mm}));
  if (bounds.is_empty()) return false;
  std::vector<std::string> places, move;
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = bounds.lo[axis], hi = bounds.hi[axis];
    const bool is_within = lo > -design::design_limit_mm && hi < design::design_limit_mm;
    move.push_back(is_within ? "0" : format_number(-std::round(lo)));
    if (is_within) continue;
    if (lo <= -wide_mm || hi >= wide_mm) return false;
    longest = std::max(longest, hi - lo);
    places.push_back(std::string(1, static_cast<char>('x' + axis)) + " = " + format_rounded(lo, 9) + " to " +
                     format_rounded(hi, 9));
  }
  if (places.empty()) return false;
  diagnostics.error(
      solid.where(),
      "this reaches from " + join(places, " and from ") + " mm; designs may reach from -1,000,000 to 1,000,000 mm",
      longest < design::design_limit_mm ? "move it: translate(" + join(move, ", ") + ')' : "scale it down");
  return true;
}

}  // namespace

design::NodePtr whole_solid(const design::Design& design) {
  if (design.parts.size() == 1) return design.parts[0].solid;
  Diagnostics none;
  return design::make_node(*nodes::registry().find("union"), {}, design.roots(),
                           {design.materials, none, nullptr, {}, "", ""});
}

Built build_program(const design::Design& design, int threads) {
  const design::NodePtr solid = whole_solid(design);
  design::LoweringContext context(design.materials, {solid}, design.voxel_mm(), threads);
  program::Builder builder;
  design::Lowering lowering(context, builder);
  const program::Point p = program::Point::origin_frame(builder);

  // Where is material, and which?
  std::vector<std::pair<std::string, program::Field>> outputs{{"inside", lowering.inside(*solid, p)}};
  const design::Composition composition = lowering.composition(*solid, p, design::Demand::inside);
  Built built;
  for (const auto& [id, fraction] : composition.fractions) {
    outputs.emplace_back(design.materials.all()[id].name, fraction);
    built.materials.materials.push_back(id);
  }
  for (const auto& [number, mark] : composition.checks) {
    outputs.emplace_back("check " + std::to_string(number), mark);
    built.checks.push_back(context.checks()[number]);
  }
  built.materials.check_count = built.checks.size();

  context.finish_bodies();
  built.materials.program = builder.finish(outputs);
  return built;
}

std::optional<voxel::MaterialProgram> build_inside_program(const design::Design& design, Diagnostics& diagnostics) {
  const design::NodePtr solid = whole_solid(design);
  design::LoweringContext context(design.materials, {solid}, design.voxel_mm());
  program::Builder builder;
  design::Lowering lowering(context, builder);
  const program::Field inside = lowering.inside(*solid, program::Point::origin_frame(builder));
  context.finish_bodies();
  const design::Material& material = design.materials.first();
  auto flat =
      flatten(builder.finish({{"inside", inside}, {material.name, builder.constant(1)}}), solid->where(), diagnostics);
  if (!flat) return std::nullopt;
  return voxel::MaterialProgram{std::move(*flat), {material.id}, 0};
}

std::optional<program::Program> flatten(const program::Program& program, const SourceRange& where,
                                        Diagnostics& diagnostics) {
  const double size = program::inlined_size(program);
  if (size <= most_instructions) return program::inline_bodies(program);
  diagnostics.error(where,
                    "the design repeats its parts too often: about " + format_rounded(size, 2) + " operations a voxel");
  return std::nullopt;
}

std::optional<Built> build_flat_program(const design::Design& design, Diagnostics& diagnostics, int threads) {
  Built built = build_program(design, threads);
  auto flat = flatten(built.materials.program, design.parts[0].solid->where(), diagnostics);
  if (!flat) return std::nullopt;
  built.materials.program = std::move(*flat);
  return built;
}

void leave_out_impossible(Built& built, const Box& box, int threads) {
  voxel::MaterialProgram& m = built.materials;
  std::vector<bool> possible = possible_outputs(m.program, box, threads);
  const auto first = possible.begin() + 1, behind = first + static_cast<ptrdiff_t>(m.materials.size());
  if (std::find(first, behind, true) == behind) *first = true;  // a program has a material, also where all is void
  std::vector<Interval> values;
  program::evaluate_intervals(m.program, box, values);
  program::Program kept = m.program;
  std::vector<MaterialId> materials;
  std::vector<design::Check> checks;
  kept.outputs.resize(1);
  kept.output_names.resize(1);
  for (size_t n = 1; n < m.program.outputs.size(); ++n) {
    if (!possible[n]) continue;
    kept.outputs.push_back(m.program.outputs[n]);
    kept.output_names.push_back(m.program.output_names[n]);
    if (n <= m.materials.size())
      materials.push_back(m.materials[n - 1]);
    else
      checks.push_back(built.checks[n - 1 - m.materials.size()]);
  }
  m.program = program::shorten(kept, values);
  m.materials = std::move(materials);
  m.check_count = checks.size();
  built.checks = std::move(checks);
}

std::optional<Box> design_box(const design::Design& design, Diagnostics& diagnostics) {
  if (design.sampling) return design.sampling->box;
  if (std::ranges::all_of(design.parts, [](const design::Part& part) { return part.solid->is_nothing(); })) {
    diagnostics.error(design.parts[0].solid->where(), "the design is empty: nothing in it makes a solid");
    return std::nullopt;
  }
  Box box;
  for (const design::Part& part : design.parts) {
    const Box bounds = part.solid->bounds(design::design_space());
    for (int axis = 0; axis < 3 && !bounds.is_empty(); ++axis) {
      if (bounds.lo[axis] > -design::design_limit_mm && bounds.hi[axis] < design::design_limit_mm) continue;
      if (report_beyond_limit(*part.solid, diagnostics)) return std::nullopt;
      diagnostics.error(
          part.solid->where(), "this has no end along " + std::string(1, static_cast<char>('x' + axis)),
          "give the function bounds, intersect it with a bounded solid, or put everything into root(min, max, voxel)");
      return std::nullopt;
    }
    box = hull(box, bounds);
  }
  if (!box.is_empty()) return box;
  for (const design::Part& part : design.parts)
    if (report_beyond_limit(*part.solid, diagnostics)) return std::nullopt;
  diagnostics.error(design.parts[0].solid->where(),
                    "nothing of the design is left: its solids do not meet, or their formulas are never 0 or less");
  return std::nullopt;
}

}  // namespace ombre::compile
