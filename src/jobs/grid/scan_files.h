// Loads files with volumes, such as scans, where commands take them instead of designs.
#pragma once

#include <string>

#include "jobs/common/job_design.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

// True for a folder, or a name with an ending of files with volumes.
bool is_scan(const std::string& path);
// Returns the numbers of a volume as a design: a solid that fills the grid, with the attributes "number", linear
// between voxels, and "nearest". Returns null, and adds diagnostics, when it cannot be read.
compile::LoadedPtr load_scan(const compile::DesignOptions& arguments, Session& session, Diagnostics& diagnostics,
                             int threads);

}  // namespace ombre::jobs
