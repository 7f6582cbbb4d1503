// Passes designs in memory to jobs that load theirs by a path.
#pragma once

#include "jobs/common/session.h"

namespace ombre::jobs {

// Returns a loader that gives the design for any path. A job that sets variables of the script, or names a materials
// file, needs the file instead: it is loaded if the path `is_file`, else it is an error.
DesignLoader memory_loader(compile::LoadedPtr design, bool is_file);

}  // namespace ombre::jobs
