// Finds the materials that the voxels of a job have.
#pragma once

#include <set>

#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Returns the materials of the request that voxels have, or more than `most` of them. Looks at whole layers until it
// knows, at first spread over the height; at all of them if few materials are seen. Throws Cancelled.
std::set<MaterialId> seen_materials(const SliceRequest& request, const LayerProducer& layers, size_t most,
                                    const SliceOptions& options, Progress* progress, const StopFlag* stop);

}  // namespace ombre::compile
