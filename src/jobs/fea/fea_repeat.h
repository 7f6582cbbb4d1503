// Cells that repeat, for ombre fea.
#pragma once

#include "fea/model/study.h"
#include "jobs/common/events.h"
#include "jobs/common/session.h"
#include "jobs/fea/fea_choices.h"
#include "jobs/fea/fea_report.h"
#include "load/loaded.h"

namespace ombre::jobs {

// The box after which the design repeats: that in which it is sampled, or its own.
std::optional<Box> period_of(const compile::Loaded& loaded, Diagnostics& diagnostics);
// The design, sampled in bricks of about the size of --cell that fill the box.
compile::LoadedPtr with_repeating_bricks(const compile::FeaChoices& arguments, const compile::LoadedPtr& loaded,
                                         const Box& period, Diagnostics& diagnostics);
// Ties copies of nodes, and holds one node.
fea::Conditions repeating_conditions(const fea::ModelView& model, const Box& period,
                                     const std::array<double, 6>& mean_strain);
// Throws WrongArgument where the arguments do not fit a cell that repeats.
void check_repeats(const compile::FeaChoices& arguments);
void tell_mean_stress(const Events& events, const Case& here, const fea::Solution& solution);

}  // namespace ombre::jobs
