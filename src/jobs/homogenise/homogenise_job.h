// Homogenisation as a part of other jobs.
#pragma once

#include <optional>

#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/homogenise/homogenise_choices.h"

namespace ombre::jobs {

JobKind homogenise_kind();

// Makes the model of a homogenisation, to see whether it can be solved: true if its result is a stiffness, false if it
// is a conductivity. Returns nothing, and adds diagnostics, if the design or its properties are wrong. Throws Error if
// solving takes more memory than is allowed.
std::optional<bool> gives_stiffness(const compile::HomogeniseChoices& a, Session& session, Diagnostics& diagnostics);

}  // namespace ombre::jobs
