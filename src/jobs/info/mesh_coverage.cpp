#include "jobs/info/mesh_coverage.h"

#include <algorithm>
#include <tuple>

#include "import/fields/result_source.h"
#include "questions/build.h"
#include "questions/design_stages.h"
#include "questions/question.h"
#include "questions/region_survey.h"

namespace ombre::compile {
namespace {

using program::Instruction;
using program::Program;

// Returns a program of everything that may read results.
std::optional<Program> whole_program(const design::Design& design, Diagnostics& diagnostics) {
  Question question(design);
  program::Outputs outputs{{"inside", question.inside()}};
  for (const auto& [id, fraction] : question.composition().fractions)
    outputs.emplace_back(design.materials.all()[id].name, fraction);
  for (const std::string& name : all_attribute_parts(design)) {
    const auto value = question.attribute(name, diagnostics);
    if (!value) return std::nullopt;
    outputs.emplace_back(name, *value);
  }
  return question.program(outputs, diagnostics);
}

// A mesh, and the place in it.
using Reading = std::tuple<std::string, program::ValueId, program::ValueId, program::ValueId>;

// Replaces the outputs, except for the first, by one for each reading: 1 in the mesh, else 0.
std::vector<Reading> outputs_of_meshes(Program& program) {
  std::vector<Reading> readings;
  program.outputs.resize(1);
  program.output_names.resize(1);
  const size_t size = program.code.size();
  for (size_t n = 0; n < size; ++n) {
    Instruction in = program.code[n];
    if (in.op != program::Op::source || !importing::is_mesh_result(*program.reads[in.aux].source)) continue;
    program::Read read = program.reads[in.aux];
    Reading reading{read.source->name(), in.a, in.b, in.c};
    if (std::ranges::find(readings, reading) != readings.end()) continue;
    read.channel = read.source->channel("inside");
    in.aux = static_cast<uint32_t>(program.reads.size());
    program.reads.push_back(std::move(read));
    program.outputs.push_back(static_cast<program::ValueId>(program.code.size()));
    program.output_names.push_back("in mesh " + std::to_string(readings.size()));
    program.code.push_back(in);
    readings.push_back(std::move(reading));
  }
  return readings;
}

// Returns a share of the samples inside.
std::optional<double> share_inside(const std::vector<float>& inside, const std::vector<float>& in_mesh) {
  double all = 0, those = 0;
  for (size_t n = 0; n < inside.size(); ++n) {
    if (!(inside[n] > 0)) continue;
    ++all;
    if (in_mesh[n] > 0) ++those;
  }
  return all > 0 ? std::optional(those / all) : std::nullopt;
}

}  // namespace

std::optional<std::vector<MeshCoverage>> survey_coverage(const Loaded& loaded, Diagnostics& diagnostics) {
  const design::Design design = with_stages(loaded.design, StageLoan());
  auto program = whole_program(design, diagnostics);
  if (!program) return std::nullopt;
  std::vector<MeshCoverage> coverage;
  const std::vector<Reading> readings = outputs_of_meshes(*program);
  if (readings.empty()) return coverage;
  const auto box = design_box(design, diagnostics);
  if (!box) return std::nullopt;
  const auto values = sample_coarsely(*program, *box);
  for (size_t n = 0; n < readings.size(); ++n)
    coverage.push_back({std::get<std::string>(readings[n]), share_inside(values[0], values[n + 1])});
  return coverage;
}

}  // namespace ombre::compile
