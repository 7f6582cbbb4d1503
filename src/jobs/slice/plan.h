// Plans a slice request and its layers from a design and the options of a job.
#pragma once

#include <optional>

#include "base/text/diagnostic.h"
#include "jobs/common/plan_options.h"
#include "jobs/slice/slice_request.h"
#include "load/loaded.h"
#include "questions/short_periods.h"
#include "stages/job_stages.h"

namespace ombre::compile {

struct Plan {
  SliceRequest request;
  RegionProducer regions;
  // Gives the voxels of `regions`, or others that are as much work and do not need whole layers.
  RegionProducer samples;
  LayerProducer producer;  // gives whole layers, by `regions`
  JobStagesPtr stages;     // to be prepared before layers are made
  ShortPeriods periods;    // of a job of materials, if its options ask for them
};

// Plans a job. Returns nothing, and adds diagnostics, when the design cannot be sliced with these options (does not
// fit, too many materials).
std::optional<Plan> plan_slice(const LoadedPtr& loaded, const PlanOptions& options, Diagnostics& diagnostics);

// Plans a job as plan_slice does, on a lattice that covers the bounded box instead of the design's own: designs on
// equal boxes have equal lattices.
std::optional<Plan> plan_over(const LoadedPtr& loaded, const Box& box, const PlanOptions& options,
                              Diagnostics& diagnostics);

}  // namespace ombre::compile
