// What happens to rows of computed values, in SIMD: choosing materials by draws, merging parts.
#pragma once

#include <span>
#include <string_view>

#include "base/math/run.h"
#include "eval/batch/batch.h"

namespace ombre::voxel {

// Where a row's draws come from: 24-bit whole numbers u, each standing for u / 2^24.
struct Draws {
  uint32_t hash = 0;                // row_hash(seed, j, k); voxel i draws draw(hash, i)
  const uint32_t* table = nullptr;  // or a row of a mask of period 64
  uint32_t offset = 0;              // voxel i draws table[(i + offset) % 64]
};

struct ChoiceRow {
  eval::Values inside;  // not 0 where there is material
  std::span<const eval::Values> thresholds;
  std::span<const MaterialId> materials;  // one more than thresholds
  Draws draws;
  int64_t i_begin = 0;  // index of the row's first voxel
  size_t count = 0;
};

struct RowSpan {
  size_t begin = 0, end = 0;  // equal: empty
};

// Rows of floats are padded as batches are. NaN counts as outside.
struct RowKernels {
  void (*choose)(const ChoiceRow& row, MaterialId* voxels);
  // Is any of the values not 0?
  bool (*any)(const eval::Values& values, size_t count);
  // Is inside[n] NaN somewhere, or values[n] where inside[n] is not 0?
  bool (*unknown)(const eval::Values& inside, const eval::Values& values, size_t count);
  // The least stretch that holds all values that are not 0.
  RowSpan (*nonzero)(const eval::Values& values, size_t count);
  // slot[n] becomes slot[n] or values[n]; their sum; values[n] where condition[n] is not 0. Nothing need be
  // aligned; batch_lanes values and slots behind the last may be read.
  void (*merge_any)(const eval::Values& values, float* slot, size_t count);
  void (*merge_sum)(const eval::Values& values, float* slot, size_t count);
  void (*merge_where)(const eval::Values& condition, const eval::Values& values, float* slot, size_t count);
};

// By the name of a set of eval::kernel_sets(); all give the same voxels.
RowKernels row_kernels(std::string_view instruction_set);

}  // namespace ombre::voxel
