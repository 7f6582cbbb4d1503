// Samples what a design is made of on a coarse lattice of cubes.
#pragma once

#include "base/system/progress.h"
#include "jobs/grid/grid_job.h"
#include "studio/designs.h"

namespace ombre::studio {

constexpr double measured_voxels = 1e6;  // samples from which volumes are estimated

struct SampledDesign {
  compile::Plan plan;
  compile::GridJob job;  // the grids that were wanted

  double pitch_mm() const { return plan.request.lattice.pitch[0].mm(); }
};

// A grid for each material: its fraction.
inline compile::GridQuery all_fractions() {
  compile::GridQuery query;
  query.fractions = true;
  return query;
}

// About so many voxels fill the box: equal boxes and numbers give equal lattices. Throws RequestError for what cannot
// be sampled, and Cancelled.
SampledDesign sample(const OpenDesign& design, const Box& box, double voxels, const StopFlag& stop,
                     const compile::GridQuery& query = all_fractions());
// Samples `form`, a changed copy of the design (one with labels of its parts, say), in the same way.
SampledDesign sample(const OpenDesign& design, const compile::LoadedPtr& form, const Box& box, double voxels,
                     const StopFlag& stop, const compile::GridQuery& query);

}  // namespace ombre::studio
