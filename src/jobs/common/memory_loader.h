// Designs in memory, for jobs that load theirs by a path.
#pragma once

#include "jobs/common/session.h"

namespace ombre::jobs {

// Gives the design whatever the path. A job that sets variables of the script, or names a materials file, needs the
// file instead: it is loaded anew where the path `is_file`, and else reported as an error.
DesignLoader memory_loader(compile::LoadedPtr design, bool is_file);

}  // namespace ombre::jobs
