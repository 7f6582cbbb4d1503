#include "voxel/selector.h"

#include "program/passes/prepare.h"
#include "program/passes/replay.h"

namespace ombre::voxel {
namespace {

using program::Field;

// Returns cumulative sums of fractions as thresholds. Fractions that are not positive, or NaN, are never picked.
std::vector<Field> shares(const std::vector<Field>& fractions) {
  std::vector<Field> sums;
  for (const Field fraction : fractions) {
    const Field share = max(fraction, 0.0);
    sums.push_back(sums.empty() ? share : sums.back() + share);
  }
  std::vector<Field> thresholds;
  for (size_t m = 0; m + 1 < sums.size(); ++m) thresholds.push_back(share(sums[m], sums.back()));
  return thresholds;
}

// Returns thresholds that give all draws to the greatest fraction; the first one wins a tie. They are 0 before it and 1
// from it on.
std::vector<Field> winners(const std::vector<Field>& fractions) {
  const size_t count = fractions.size();
  std::vector<Field> after(count);  // greatest of the following fractions
  for (size_t m = count; m-- > 1;) after[m - 1] = m + 1 < count ? max(fractions[m], after[m]) : fractions[m];
  std::vector<Field> thresholds;
  Field best = fractions[0];
  for (size_t m = 0; m + 1 < count; ++m) {
    if (m > 0) best = max(best, fractions[m]);
    thresholds.push_back(less_equal(after[m], best));
  }
  return thresholds;
}

}  // namespace

std::optional<MaterialId> Selector::settled(const program::Program& program,
                                            const std::vector<Interval>& ranges) const {
  const Interval inside = ranges[program.outputs[0]];
  if (inside == Interval(0)) return MaterialId{0};
  if (settles_outside_only || !(inside == Interval(1))) return std::nullopt;
  size_t chosen = threshold_count;
  for (size_t t = threshold_count; t-- > 0;) {
    const Interval threshold = ranges[program.outputs[1 + t]];
    if (threshold == Interval(1))
      chosen = t;
    else if (!(threshold == Interval(0)))
      return std::nullopt;
  }
  for (size_t n = 1 + threshold_count; n < program.outputs.size(); ++n)
    if (!(ranges[program.outputs[n]] == Interval(0))) return std::nullopt;
  return materials[chosen];
}

Selector make_selector(const MaterialProgram& materials, Dither dither) {
  const program::Program& from = materials.program;
  program::Builder builder;
  const auto fields = replay(builder, from, {builder.input(0), builder.input(1), builder.input(2)});
  std::vector<std::pair<std::string, Field>> outputs{{from.output_names[0], fields[from.outputs[0]]}};
  std::vector<Field> fractions;
  const size_t count = materials.materials.size();
  for (size_t m = 0; m < count; ++m) fractions.push_back(fields[from.outputs[1 + m]]);
  const auto thresholds = dither == Dither::threshold ? winners(fractions) : shares(fractions);
  for (size_t m = 0; m < thresholds.size(); ++m) outputs.emplace_back(from.output_names[1 + m], thresholds[m]);
  for (size_t n = 1 + count; n < from.outputs.size(); ++n)
    outputs.emplace_back(from.output_names[n], fields[from.outputs[n]]);

  Selector selector;
  selector.reference = builder.finish(outputs);
  selector.materials = materials.materials;
  selector.threshold_count = thresholds.size();
  selector.check_count = materials.check_count;
  selector.settles_outside_only = dither == Dither::diffusion;
  return selector;
}

void make_batch(Selector& selector) { selector.batch = program::prepare(selector.reference, program::Purpose::batch); }

}  // namespace ombre::voxel
