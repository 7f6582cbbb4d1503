// Periodic cells for `ombre fea`.
#pragma once

#include "fea/model/study.h"
#include "jobs/common/events.h"
#include "jobs/common/session.h"
#include "jobs/fea/fea_choices.h"
#include "jobs/fea/fea_report.h"
#include "load/loaded.h"

namespace ombre::jobs {

// Returns the box after which the design repeats: the box of its `root`, or its bounds.
std::optional<Box> period_of(const compile::Loaded& loaded, Diagnostics& diagnostics);
// Returns the design, sampled in bricks of about the size of --cell that fill the box.
compile::LoadedPtr with_repeating_bricks(const compile::FeaChoices& arguments, const compile::LoadedPtr& loaded,
                                         const Box& period, Diagnostics& diagnostics);
// Ties copies of nodes, and holds one node.
fea::Conditions repeating_conditions(const fea::ModelView& model, const Box& period,
                                     const std::array<double, 6>& mean_strain);
// Throws WrongArgument if the arguments do not fit a periodic cell.
void check_repeats(const compile::FeaChoices& arguments);
void tell_mean_stress(const Events& events, const Case& here, const fea::Solution& solution);

}  // namespace ombre::jobs
