// Voxels that are spread evenly over a box.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace ombre::voxel {

// Returns the voxel of this number in a sequence that fills a box evenly (Roberts 2018: the generalised golden ratio).
inline std::array<int64_t, 3> spread_voxel(uint64_t n, const std::array<int64_t, 3>& count) {
  constexpr double ratio = 1.2207440846057596;
  constexpr std::array<double, 3> steps{1 / ratio, 1 / (ratio * ratio), 1 / (ratio * ratio * ratio)};
  std::array<int64_t, 3> voxel{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double share = 0.5 + static_cast<double>(n) * steps[axis];
    voxel[axis] = static_cast<int64_t>((share - std::floor(share)) * static_cast<double>(count[axis]));
  }
  return voxel;
}

}  // namespace ombre::voxel
