// ombre optimise with a study of topology.
#pragma once

#include "base/data.h"
#include "compile/optimise_choices.h"
#include "ombre/commands.h"

namespace ombre::cli {

// Writes density.nrrd, topology.vcad, history.csv and chart.svg into the folder. Returns an exit code.
int optimise_topology(const compile::OptimiseChoices& choices, const Data& study, Session& session);

}  // namespace ombre::cli
