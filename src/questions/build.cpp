#include "questions/build.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "program/passes/narrow.h"
#include "questions/possible_outputs.h"

namespace ombre::compile {
namespace {

// Returns true, and adds a diagnostic, if a solid lies beyond the limit of designs. Meshes and CAD solids may lie
// anywhere.
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
      Code::limit, solid.where(),
      "this reaches from " + join(places, " and from ") + " mm; designs may reach from -1,000,000 to 1,000,000 mm",
      longest < design::design_limit_mm
          ? "move it: " + spelled::either("translate(" + join(move, ", ") + ')',
                                          "\"by\": [" + join(move, ", ") + "] of a translate",
                                          "translate(" + join(move, ", ") + ')')
          : "scale it down");
  return true;
}

}  // namespace

namespace {

// Adds outputs that say where there is material, and which.
program::Outputs add_materials(Question& question, Built& built) {
  program::Outputs outputs{{"inside", question.inside()}};
  const design::Composition composition = question.composition();
  for (const auto& [id, fraction] : composition.fractions) {
    outputs.emplace_back(question.design().materials.all()[id].name, fraction);
    built.materials.materials.push_back(id);
  }
  for (const auto& [number, flag] : composition.checks) {
    outputs.emplace_back("check " + std::to_string(number), flag);
    built.checks.push_back(question.check(number));
  }
  built.materials.check_count = built.checks.size();
  return outputs;
}

}  // namespace

Built build_program(const design::Design& design, int threads) {
  Question question(design, {.threads = threads});
  Built built;
  const program::Outputs outputs = add_materials(question, built);
  built.materials.program = question.program_with_calls(outputs);
  return built;
}

std::optional<Built> build_flat_program(const design::Design& design, Diagnostics& diagnostics, int threads,
                                        design::SubDesignMemory* memory) {
  Question question(design, {.threads = threads, .memory = memory});
  Built built;
  auto program = question.program(add_materials(question, built), diagnostics);
  if (!program) return std::nullopt;
  built.materials.program = std::move(*program);
  return built;
}

std::optional<voxel::MaterialProgram> build_inside_program(const design::Design& design, Diagnostics& diagnostics) {
  Question question(design);
  const design::Material& material = design.materials.first();
  const program::Field inside = question.inside();
  auto program = question.program({{"inside", inside}, {material.name, question.builder().constant(1)}}, diagnostics);
  if (!program) return std::nullopt;
  return voxel::MaterialProgram{std::move(*program), {material.id}, 0};
}

void leave_out_impossible(Built& built, const Box& box, int threads) {
  voxel::MaterialProgram& m = built.materials;
  std::vector<bool> possible = possible_outputs(m.program, box, threads);
  const auto first = possible.begin() + 1, behind = first + static_cast<ptrdiff_t>(m.materials.size());
  if (std::find(first, behind, true) == behind) *first = true;  // a program has a material even if everything is void
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
  m.program = program::narrow(kept, box).program;
  m.materials = std::move(materials);
  m.check_count = checks.size();
  built.checks = std::move(checks);
}

std::optional<Box> design_box(const design::Design& design, Diagnostics& diagnostics) {
  if (design.sampling) return design.sampling->box;
  if (std::ranges::all_of(design.parts, [](const design::Part& part) { return part.solid->is_nothing(); })) {
    diagnostics.error(Code::nothing_inside, design.parts[0].solid->where(),
                      "the design is empty: nothing in it makes a solid");
    return std::nullopt;
  }
  Box box;
  for (const design::Part& part : design.parts) {
    const Box bounds = part.solid->bounds(design::design_space());
    for (int axis = 0; axis < 3 && !bounds.is_empty(); ++axis) {
      if (bounds.lo[axis] > -design::design_limit_mm && bounds.hi[axis] < design::design_limit_mm) continue;
      if (report_beyond_limit(*part.solid, diagnostics)) return std::nullopt;
      diagnostics.error(
          Code::unbounded, part.solid->where(),
          "the solid is unbounded along " + std::string(1, static_cast<char>('x' + axis)),
          "give the function bounds, intersect it with a bounded solid, or " +
              spelled::either("put everything into root(min, max, voxel)", "say \"sampling\" with min, max and voxel",
                              "give the design a box and a voxel: ombre.Design(solid, box=..., voxel=...)"));
      return std::nullopt;
    }
    box = hull(box, bounds);
  }
  if (!box.is_empty()) return box;
  for (const design::Part& part : design.parts)
    if (report_beyond_limit(*part.solid, diagnostics)) return std::nullopt;
  diagnostics.error(Code::nothing_inside, design.parts[0].solid->where(),
                    "nothing of the design is left: its solids do not meet, or their formulas are never 0 or less");
  return std::nullopt;
}

}  // namespace ombre::compile
