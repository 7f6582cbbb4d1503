#include "jobs/fea/fea_repeat.h"

#include "base/text/json.h"
#include "base/text/text.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/session.h"
#include "jobs/fea/periodic_box.h"
#include "questions/build.h"

namespace ombre::jobs {

std::optional<Box> period_of(const compile::Loaded& loaded, Diagnostics& diagnostics) {
  if (loaded.design.sampling) return loaded.design.sampling->box;
  return compile::design_box(loaded.design, diagnostics);
}

compile::LoadedPtr with_repeating_bricks(const compile::FeaChoices& a, const compile::LoadedPtr& loaded,
                                         const Box& period, Diagnostics& diagnostics) {
  const options::Pitches& cell = *a.cell;
  if (cell[1] != cell[0] || cell[2] != cell[0])
    throw WrongArgument("a cell that repeats is cut into bricks of one length: --cell 0.5");
  const auto box = compile::periodic_box(loaded, period, cell[0]->mm(), diagnostics);
  return box ? compile::sampled_by(loaded, *box) : nullptr;
}

fea::Conditions repeating_conditions(const fea::ModelView& model, const Box& period,
                                     const std::array<double, 6>& mean_strain) {
  fea::Conditions conditions;
  conditions.repeat = fea::Repeat{period.size(), fea::ties_of(model.mesh, period.size()), mean_strain};
  // Node 0 can be held, since the first node is not a copy.
  for (uint8_t axis = 0; axis < 3; ++axis) conditions.displacements.push_back({0, axis, 0});
  return conditions;
}

void check_repeats(const compile::FeaChoices& a) {
  if (a.solves() && a.has_own_solver())
    throw WrongArgument(
        "a cell that repeats is solved by --solver calculix, or, for all strains and without other programs, by ombre "
        "homogenise");
  if (a.rounds > 0) throw WrongArgument("--rounds does not go with \"mean_strain\"");
}

void tell_mean_stress(const Events& events, const Case& here, const fea::Solution& solution) {
  if (!here.conditions.repeat) return;
  const auto mean = fea::mean_stress(here.view().mesh, solution.stress_mpa, here.conditions.repeat->period_mm);
  std::vector<std::string> words;
  DataList numbers;
  for (const double stress : mean) {
    words.push_back(format_rounded(stress, 5));
    numbers.emplace_back(stress);
  }
  events.say("mean stress, MPa, xx yy zz xy yz zx: " + join(words, " "));
  events.event("mean_stress", {{"mpa", numbers}});
}

}  // namespace ombre::jobs
