// What people choose of voxel grids.
#pragma once

#include <optional>
#include <string>

#include "compile/grid_job.h"
#include "compile/job_options.h"

namespace ombre::compile {

struct GridChoices {
  DesignOptions design;
  SamplingOptions sampling;
  std::string output, what;
  std::optional<Box> box;
  WorkOptions work;
  bool gzip = false, force = false;

  static const options::Spec<GridChoices>& options();
  // `usual`: what voxels hold where --what does not say. Sparse grids hold distances near the surface alone. Throws
  // options::WrongValue.
  GridWishes wishes(const std::string& usual, bool is_sparse) const;
};

}  // namespace ombre::compile
