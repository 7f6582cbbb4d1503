// Grids of a job as one file of VTK image data: .vti.
#pragma once

#include <string>

#include "jobs/grid/grid_job.h"
#include "jobs/grid/grid_report.h"

namespace ombre::compile {

// Vectors and colours become arrays of several components, a mixture one with a component for each material. Keeps a
// few layers in memory. The file gets its name when it is complete. Throws Error and Cancelled; then nothing is left.
GridReport write_vti(const GridJob& job, const std::string& path, int threads, Progress* progress = nullptr,
                     const StopFlag* stop = nullptr);

}  // namespace ombre::compile
