// Distances from points to the border between two regions.
#pragma once

#include <optional>
#include <vector>

#include "base/math/vec.h"
#include "base/system/progress.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// A point near the border between two regions, and the border's unit normal there, from region `from` into region `to`.
struct BorderSample {
  Vec3 at, normal;
  Label from = 0, to = 0;
};

// Returns for each sample the signed distance in mm to the border along the normal, at most `reach_mm` either way; null
// if the ends of that segment do not lie in the regions `from` and `to`. Throws Cancelled.
std::vector<std::optional<double>> border_offsets(const Partition& partition, const std::vector<BorderSample>& samples,
                                                  double reach_mm, int threads, const StopFlag* stop = nullptr);

}  // namespace ombre::surface
