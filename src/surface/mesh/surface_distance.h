// How far points are from the borders of regions, and from triangles.
#pragma once

#include <array>
#include <vector>

#include "base/math/vec.h"
#include "base/system/progress.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// A point that should lie on a border, and how the border should lie there.
struct SurfaceSample {
  Vec3 at, normal;
};

// Numbers of samples, in order.
struct FarSamples {
  std::vector<uint32_t> far;     // from which no other region was found within reach, along the normal and all around
  std::vector<uint32_t> beside;  // others, with the same region a reach before and behind them
};

// Throws Cancelled.
FarSamples find_far_samples(const Partition& partition, const std::vector<SurfaceSample>& samples, double reach_mm,
                            int threads, const StopFlag* stop = nullptr);

// How far the farthest is, or a quarter more; no less than the reach, no more than 16 times it. Throws Cancelled.
double farthest_mm(const Partition& partition, std::vector<SurfaceSample> samples, double reach_mm, int threads,
                   const StopFlag* stop = nullptr);

double distance_to_triangle(Vec3 point, const std::array<Vec3, 3>& corners);

}  // namespace ombre::surface
