// The program that determines a voxel's material: whether it is inside, and the share of the draws for each material.
#pragma once

#include "voxel/dither.h"
#include "voxel/material_program.h"

namespace ombre::voxel {

// Programs with these outputs: 0 is the truth value "inside". Then follows a threshold for each material except the
// last. The material is the first whose threshold exceeds a draw u in [0, 1), else the last (2023 paper, Algorithm 1).
// Thresholds do not decrease, and do not exceed 1. The last outputs are the checks.
struct Selector {
  program::Program reference;
  program::Program batch;  // program for floats, with fused multiply-adds instead of affine maps; see make_batch
  std::vector<MaterialId> materials;
  size_t threshold_count = 0, check_count = 0;
  // Set for error diffusion, which needs all fractions: only regions outside can be settled by ranges.
  bool settles_outside_only = false;

  // Returns the material of all voxels of a region in which the outputs have these ranges: 0 if nothing is inside,
  // nothing if the ranges do not determine the material or a check may fail.
  std::optional<MaterialId> settled(const program::Program& program, const std::vector<Interval>& ranges) const;
};

// Returns a selector without `batch`, which make_batch makes from `reference` after its reads have their tags.
Selector make_selector(const MaterialProgram& materials, Dither dither);
void make_batch(Selector& selector);

}  // namespace ombre::voxel
