// Voxel grids whose slabs of layers several processes make.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "jobs/common/shared_job.h"
#include "jobs/grid/grid_choices.h"
#include "jobs/grid/volume_files.h"

namespace ombre::jobs {

// A planned grid and its files.
struct DenseGrid {
  compile::GridJob job;
  std::vector<std::string> paths;
  compile::DenseFormat format;
};

using TellReport = std::function<void(const Events& events, const compile::GridReport& report)>;

// The slabs lie in a folder beside the files, part.npy.slabs, until they are joined. The key has all that decides the
// numbers.
SharedJobPtr share_grid(const compile::GridChoices& choices, DenseGrid grid, stores::JobKey key, TellReport tell);

}  // namespace ombre::jobs
