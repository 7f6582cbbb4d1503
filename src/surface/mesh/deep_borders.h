// Finds borders in front of or behind a surface that misses them, such as the bottoms of narrow valleys and the edges
// of thin fins.
#pragma once

#include <vector>

#include "base/system/progress.h"
#include "surface/mesh/surface_distance.h"

namespace ombre::surface {

struct DeepBorder {
  uint32_t sample = 0;  // number of the sample
  Vec3 at;              // mm, on the border
};

// Returns the first border on the normal of each sample in `numbers`, in either direction, between one and four reaches
// away. Results are in the order of the numbers. Throws Cancelled.
std::vector<DeepBorder> find_deep_borders(const Partition& partition, const std::vector<SurfaceSample>& samples,
                                          const std::vector<uint32_t>& numbers, double reach_mm, int threads,
                                          const StopFlag* stop = nullptr);

}  // namespace ombre::surface
