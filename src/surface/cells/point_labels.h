// Evaluates the regions of scattered points in parallel.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "base/system/progress.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// Returns the label at each point, from the reference evaluator. Throws Cancelled.
std::vector<Label> labels_at(const Partition& partition, const std::vector<Vec3>& points, int threads,
                             const StopFlag* stop = nullptr);

}  // namespace ombre::surface
