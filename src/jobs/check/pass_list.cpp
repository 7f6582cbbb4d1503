#include "jobs/check/pass_list.h"

#include "base/system/stopwatch.h"
#include "program/passes/passes.h"
#include "program/passes/prepare.h"
#include "questions/build.h"
#include "voxel/selector.h"

namespace ombre::compile {
namespace {

struct Step {
  const char *name, *sentence;
};
constexpr Step lower{"lower", "The design's nodes become operations; what is used more than once is called."};
constexpr Step write_out{"write-out-calls", "The code of what is called stands where it is called."};
constexpr Step leave_out{"leave-out-impossible", "Materials and checks that cannot occur in the design's box go."};
constexpr Step thresholds{"thresholds", "Fractions become each material's share of the draws that choose voxels."};

}  // namespace

std::vector<PassResult> slicing_passes(const design::Design& design) {
  std::vector<PassResult> results;
  const Stopwatch watch;
  double before = 0;
  const auto add = [&](std::string_view name, std::string_view sentence, const program::Program& program) {
    const double now = watch.seconds();
    results.push_back({std::string(name), std::string(sentence), program, now - before});
    before = watch.seconds();
  };
  Diagnostics ignored;
  Built built = build_program(design);
  add(lower.name, lower.sentence, built.materials.program);
  if (program::inlined_size(built.materials.program) > most_instructions) return results;
  built.materials.program = program::inline_bodies(built.materials.program);
  add(write_out.name, write_out.sentence, built.materials.program);
  const auto box = design_box(design, ignored);
  if (!box) return results;
  leave_out_impossible(built, *box, 1);
  add(leave_out.name, leave_out.sentence, built.materials.program);
  const voxel::Selector selector = voxel::make_selector(built.materials, voxel::Dither::stochastic);
  add(thresholds.name, thresholds.sentence, selector.reference);
  program::prepare(
      selector.reference, program::Purpose::batch,
      [&](const program::Pass& pass, const program::Program& made) { add(pass.name, pass.sentence, made); });
  return results;
}

std::vector<std::string> slicing_pass_names() {
  std::vector<std::string> names{lower.name, write_out.name, leave_out.name, thresholds.name};
  for (const program::Pass& pass : program::passes_for(program::Purpose::batch)) names.emplace_back(pass.name);
  return names;
}

}  // namespace ombre::compile
