// Samples the materials of a design on a coarse lattice of cubes.
#pragma once

#include "base/system/progress.h"
#include "jobs/grid/grid_job.h"
#include "studio/designs.h"

namespace ombre::studio {

constexpr double measured_voxels = 1e6;  // number of samples from which volumes are estimated

struct SampledDesign {
  compile::Plan plan;
  compile::GridJob job;  // the grids that were requested

  double pitch_mm() const { return plan.request.lattice.pitch[0].mm(); }
};

// Requests a grid for each material, of its fraction.
inline compile::GridQuery all_fractions() {
  compile::GridQuery query;
  query.fractions = true;
  return query;
}

// Samples with about `voxels` voxels in the box: equal boxes and numbers give equal lattices. Throws RequestError if
// the design cannot be sampled, and Cancelled.
SampledDesign sample(const OpenDesign& design, const Box& box, double voxels, const StopFlag& stop,
                     const compile::GridQuery& query = all_fractions());
// Samples `form`, a changed copy of the design (for example one with labels of its parts), in the same way.
SampledDesign sample(const OpenDesign& design, const compile::LoadedPtr& form, const Box& box, double voxels,
                     const StopFlag& stop, const compile::GridQuery& query);

}  // namespace ombre::studio
