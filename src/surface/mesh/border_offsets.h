// How far the border between two regions lies from points beside it.
#pragma once

#include <optional>
#include <vector>

#include "base/math/vec.h"
#include "base/system/progress.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// A point near the border between two regions, and the unit normal there, out of region `from` into region `to`.
struct BorderSample {
  Vec3 at, normal;
  Label from = 0, to = 0;
};

// In mm along the normals, no more than the reach either way; nothing where the ends of that way lie in other regions.
// Throws Cancelled.
std::vector<std::optional<double>> border_offsets(const Partition& partition, const std::vector<BorderSample>& samples,
                                                  double reach_mm, int threads, const StopFlag* stop = nullptr);

}  // namespace ombre::surface
