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
  // Sparse grids hold other grids unless some are chosen, and distances near the surface. Throws options::WrongValue.
  GridWishes wishes(bool is_sparse) const;
};

}  // namespace ombre::compile
