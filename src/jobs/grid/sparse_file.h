// Writes grids of a job as one sparse file: .vdb and .nvdb.
#pragma once

#include <string>

#include "jobs/grid/grid_job.h"
#include "jobs/grid/grid_report.h"
#include "vdb/sparse_grids.h"

namespace ombre::compile {

// Writes the file. Blocks that are not uniform are kept in memory. The file gets its name when it is complete. Throws
// Error and Cancelled, and leaves nothing then.
GridReport write_sparse(const GridJob& job, const std::string& path, vdb::FileFormat format, int threads,
                        Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::compile
