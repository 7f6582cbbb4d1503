// The stages of a design, whose solids become programs here.
#pragma once

#include "base/text/diagnostic.h"
#include "base/text/error.h"
#include "design/design.h"
#include "stages/job_stages.h"

namespace ombre::compile {

// The design with stages of its own, for one job.
design::Design with_stages(design::Design design, const StageLoan& loan);
// The stages of a design for a job: those that the job has given it, or else new ones.
JobStagesPtr stages_of(const design::Design& design);

// For stages that cannot be evaluated: all messages, with the code and the values of the first error.
Error error_of(const Diagnostics& diagnostics);

}  // namespace ombre::compile
