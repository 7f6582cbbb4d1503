// The draw of each voxel, by which a mixture becomes one material.
#pragma once

#include "voxel/choose.h"
#include "voxel/quantise.h"

namespace ombre::voxel {

// The draws of row j of layer k.
inline Draws draws_of_row(uint64_t seed, int64_t j, int64_t k) { return {row_hash(seed, j, k), nullptr, 0}; }

// A whole number below 2^24, for voxel i of the row.
inline uint32_t draw(const Draws& row, int64_t i) {
  if (row.table) return row.table[(static_cast<uint32_t>(i) + row.offset) & 63];
  return hashed_draw(row.hash, i);
}

}  // namespace ombre::voxel
