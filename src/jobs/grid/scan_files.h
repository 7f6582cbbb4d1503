// Files with volumes (scans, say), where commands take them in place of designs.
#pragma once

#include <string>

#include "jobs/common/job_design.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

// Is it a folder, or does its name end like those of files with volumes?
bool is_scan(const std::string& path);
// The numbers of a volume as a design: a solid that fills the grid, with the attributes "number", linear between
// voxels, and "nearest". Null, and diagnostics, when it cannot be read.
compile::LoadedPtr load_scan(const compile::DesignOptions& arguments, Session& session, Diagnostics& diagnostics,
                             int threads);

}  // namespace ombre::jobs
