// Grids of a job as one sparse file: .vdb and .nvdb.
#pragma once

#include <string>

#include "jobs/grid/grid_job.h"
#include "jobs/grid/grid_report.h"
#include "vdb/sparse_grids.h"

namespace ombre::compile {

// Keeps in memory what is not uniform. The file gets its name when it is complete. Throws Error and Cancelled; then
// nothing is left.
GridReport write_sparse(const GridJob& job, const std::string& path, vdb::FileFormat format, int threads,
                        Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::compile
