// Makes voxel grids for programs that hold them in memory.
#pragma once

#include <vector>

#include "jobs/common/session.h"
#include "jobs/grid/grid_choices.h"
#include "jobs/grid/volume_files.h"

namespace ombre::jobs {

// Makes the grids that `ombre voxels` would write, whatever the name of the output. Returns an exit code. Throws as
// jobs do.
int make_voxels(const compile::GridChoices& choices, Session& session, std::vector<compile::VolumeInMemory>& made);

}  // namespace ombre::jobs
