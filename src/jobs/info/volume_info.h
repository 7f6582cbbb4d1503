// Describes a volume for `ombre info`: as text, as data for programs, and as a picture of three planes.
#pragma once

#include "jobs/common/session.h"
#include "jobs/info/info_choices.h"

namespace ombre::jobs {

// Prints the contents of the file or folder; returns an exit code. Throws Error.
int show_volume(const InfoChoices& choices, Session& session);

}  // namespace ombre::jobs
