// The draws by which a mixture is turned into one material per voxel.
#pragma once

#include "voxel/blue_noise.h"
#include "voxel/leaf.h"
#include "voxel/row_kernels.h"

namespace ombre::voxel {

// Returns the draws of row j of layer k. With error diffusion, and where all fractions are 0 or 1, they have no effect.
inline Draws draws_of_row(const VoxelJob& job, int64_t j, int64_t k) {
  if (job.dither != Dither::blue_noise) return {row_hash(job.seed, j, k), nullptr, 0};
  const BlueNoiseRow row = blue_noise_row(job.noise, job.seed, j, k);
  return {0, row.draws, row.offset};
}

// Returns an integer below 2^24 for voxel i of the row.
inline uint32_t draw(const Draws& row, int64_t i) {
  if (row.table) return row.table[(static_cast<uint32_t>(i) + row.offset) % blue_noise_width];
  return hashed_draw(row.hash, i);
}

}  // namespace ombre::voxel
