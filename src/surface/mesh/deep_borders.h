// Borders before or behind a surface that passes them by, as the depths of narrow valleys and the edges of thin fins.
#pragma once

#include <vector>

#include "base/system/progress.h"
#include "surface/mesh/surface_distance.h"

namespace ombre::surface {

struct DeepBorder {
  uint32_t sample = 0;  // its number
  Vec3 at;              // mm, on the border
};

// Where the normals of the samples of some numbers meet a border first, either way, between one and four reaches away.
// In order of the numbers. Throws Cancelled.
std::vector<DeepBorder> find_deep_borders(const Partition& partition, const std::vector<SurfaceSample>& samples,
                                          const std::vector<uint32_t>& numbers, double reach_mm, int threads,
                                          const StopFlag* stop = nullptr);

}  // namespace ombre::surface
