// From a design and the options of a job to a slice request and its layers.
#pragma once

#include <optional>

#include "base/text/diagnostic.h"
#include "jobs/common/plan_options.h"
#include "jobs/slice/slice_request.h"
#include "load/loaded.h"
#include "stages/job_stages.h"

namespace ombre::compile {

struct Plan {
  SliceRequest request;
  RegionProducer regions;
  RegionProducer samples;  // what `regions` gives, or voxels that are as much work and do not need whole layers
  LayerProducer producer;  // of whole layers, by `regions`
  JobStagesPtr stages;     // to be prepared before layers are made
};

// Nothing, and diagnostics, when the design cannot be sliced so (does not fit, too many materials).
std::optional<Plan> plan_slice(const LoadedPtr& loaded, const PlanOptions& options, Diagnostics& diagnostics);

// As plan_slice, on a lattice that covers the box, which is bounded, in place of the design's own: designs on equal
// boxes have equal lattices.
std::optional<Plan> plan_over(const LoadedPtr& loaded, const Box& box, const PlanOptions& options,
                              Diagnostics& diagnostics);

}  // namespace ombre::compile
