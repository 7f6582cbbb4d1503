// Runs `ombre optimise` with a study of topology.
#pragma once

#include "base/text/data.h"
#include "jobs/common/session.h"
#include "jobs/optimise/optimise_choices.h"

namespace ombre::jobs {

// Writes density.nrrd, topology.vcad, history.csv and chart.svg into the folder. Returns an exit code.
int optimise_topology(const compile::OptimiseChoices& choices, const Data& study, Session& session);

}  // namespace ombre::jobs
