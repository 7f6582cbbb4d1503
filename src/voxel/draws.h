// The draw of each voxel, by which a mixture becomes one material.
#pragma once

#include "voxel/blue_noise.h"
#include "voxel/leaf.h"
#include "voxel/row_kernels.h"

namespace ombre::voxel {

// The draws of row j of layer k. Where fractions are 0 or 1, or errors are diffused, it does not matter which.
inline Draws draws_of_row(const VoxelJob& job, int64_t j, int64_t k) {
  if (job.dither != Dither::blue_noise) return {row_hash(job.seed, j, k), nullptr, 0};
  const BlueNoiseRow row = blue_noise_row(job.noise, job.seed, j, k);
  return {0, row.draws, row.offset};
}

// A whole number below 2^24, for voxel i of the row.
inline uint32_t draw(const Draws& row, int64_t i) {
  if (row.table) return row.table[(static_cast<uint32_t>(i) + row.offset) % blue_noise_width];
  return hashed_draw(row.hash, i);
}

}  // namespace ombre::voxel
