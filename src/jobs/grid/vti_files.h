// Writes grids of a job as one file of VTK image data: .vti.
#pragma once

#include <string>

#include "jobs/grid/grid_job.h"
#include "jobs/grid/grid_report.h"

namespace ombre::compile {

// Writes the file, and keeps a few layers in memory. Vectors and colours become arrays of several components; a mixture
// becomes one with a component for each material. The file gets its name when it is complete. Throws Error and
// Cancelled, and leaves nothing then.
GridReport write_vti(const GridJob& job, const std::string& path, int threads, Progress* progress = nullptr,
                     const StopFlag* stop = nullptr);

}  // namespace ombre::compile
