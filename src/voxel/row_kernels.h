// SIMD functions on rows of computed values: choosing materials by draws, and merging parts.
#pragma once

#include <span>
#include <string_view>

#include "base/math/run.h"
#include "eval/batch/batch.h"

namespace ombre::voxel {

// The draws of a row: 24-bit integers u, each of which stands for u / 2^24.
struct Draws {
  uint32_t hash = 0;                // row_hash(seed, j, k); voxel i has the draw hashed_draw(hash, i)
  const uint32_t* table = nullptr;  // row of a mask with period 64; null if the hash is used
  uint32_t offset = 0;              // voxel i has the draw table[(i + offset) % 64]
};

struct ChoiceRow {
  eval::Values inside;  // values that are not 0 where there is material
  std::span<const eval::Values> thresholds;
  std::span<const MaterialId> materials;  // one more than thresholds
  Draws draws;
  int64_t i_begin = 0;  // index of the row's first voxel
  size_t count = 0;
};

struct RowSpan {
  size_t begin = 0, end = 0;  // empty if equal
};

// Functions on rows of floats, which are padded like those of batches. NaN counts as outside.
struct RowKernels {
  void (*choose)(const ChoiceRow& row, MaterialId* voxels);
  // True if one of the values is not 0.
  bool (*any)(const eval::Values& values, size_t count);
  // True if some inside[n] is NaN, or some values[n] is NaN where inside[n] is not 0.
  bool (*unknown)(const eval::Values& inside, const eval::Values& values, size_t count);
  // Returns the shortest stretch that contains all values that are not 0.
  RowSpan (*nonzero)(const eval::Values& values, size_t count);
  // merge_any sets slot[n] to the logical `or` of slot[n] and values[n], merge_sum to their sum, and merge_where to
  // values[n] where condition[n] is not 0. Pointers need not be aligned. Up to batch_lanes values and slots after the
  // last one may be read.
  void (*merge_any)(const eval::Values& values, float* slot, size_t count);
  void (*merge_sum)(const eval::Values& values, float* slot, size_t count);
  void (*merge_where)(const eval::Values& condition, const eval::Values& values, float* slot, size_t count);
};

// Returns the kernels for a set of eval::kernel_sets(), by its name. All sets give the same voxels.
RowKernels row_kernels(std::string_view instruction_set);

}  // namespace ombre::voxel
