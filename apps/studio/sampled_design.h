// Samples designs on a coarse lattice of cubes.
#pragma once

#include "base/system/progress.h"
#include "jobs/grid/grid_job.h"
#include "studio/designs.h"

namespace ombre::studio {

constexpr double measured_voxels = 1e6;  // number of samples from which volumes are estimated

struct SampledDesign {
  compile::Plan plan;
  compile::GridJob job;  // the requested grids

  double pitch_mm() const { return plan.request.lattice.pitch[0].mm(); }
};

// Returns a query for a grid of each material's fraction.
inline compile::GridQuery all_fractions() {
  compile::GridQuery query;
  query.fractions = true;
  return query;
}

// Samples a design with about `voxels` voxels in the box. Equal boxes and numbers give equal lattices. Throws
// RequestError for designs that cannot be sampled, and Cancelled.
SampledDesign sample(const OpenDesign& design, const Box& box, double voxels, const StopFlag& stop,
                     const compile::GridQuery& query = all_fractions());
// Samples `form`, a modified copy of the design such as one with labels of its parts, in the same way.
SampledDesign sample(const OpenDesign& design, const compile::LoadedPtr& form, const Box& box, double voxels,
                     const StopFlag& stop, const compile::GridQuery& query);

}  // namespace ombre::studio
