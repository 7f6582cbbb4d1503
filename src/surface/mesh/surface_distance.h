// Distances from points to the borders of regions and to triangles.
#pragma once

#include <array>
#include <vector>

#include "base/math/vec.h"
#include "base/system/progress.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// A point that should lie on a border, and the normal that the border should have there.
struct SurfaceSample {
  Vec3 at, normal;
};

// Numbers of samples, ascending.
struct FarSamples {
  std::vector<uint32_t> far;     // samples with no other region within reach, along the normal and all around
  std::vector<uint32_t> beside;  // other samples, with the same region one reach in front and behind
};

// Searches around each sample for another region. Throws Cancelled.
FarSamples find_far_samples(const Partition& partition, const std::vector<SurfaceSample>& samples, double reach_mm,
                            int threads, const StopFlag* stop = nullptr);

// Returns an upper bound on the distance of the farthest sample from a border, at most a quarter too high, limited to 1
// to 16 times the reach. Throws Cancelled.
double farthest_mm(const Partition& partition, std::vector<SurfaceSample> samples, double reach_mm, int threads,
                   const StopFlag* stop = nullptr);

double distance_to_triangle(Vec3 point, const std::array<Vec3, 3>& corners);

}  // namespace ombre::surface
