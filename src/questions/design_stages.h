// Gives a design the stages of a job, and makes programs of their solids.
#pragma once

#include "base/text/diagnostic.h"
#include "base/text/error.h"
#include "design/design.h"
#include "stages/job_stages.h"

namespace ombre::compile {

// Returns the design with stages of its own, for one job.
design::Design with_stages(design::Design design, const StageLoan& loan);
// Returns the stages that the job has given to the design, or else new ones.
JobStagesPtr stages_of(const design::Design& design);

// Makes an Error for stages that cannot be evaluated. It has all messages, with the code and the values of the first
// error.
Error error_of(const Diagnostics& diagnostics);

}  // namespace ombre::compile
