// What decides a voxel's material, as a program: is it inside, and which share of the draws goes to
// which material.
#pragma once

#include "voxel/dither.h"
#include "voxel/material_program.h"

namespace ombre::voxel {

// Outputs of the programs: 0 is the truth value "inside"; then a threshold for each material but the
// last: the material is the first whose threshold lies above a draw u in [0, 1), else the last (2023
// paper, Algorithm 1). Thresholds grow from material to material and end at 1. Then the checks.
struct Selector {
  program::Program reference;
  program::Program batch;  // for floats: without affine maps, with fused multiply-adds; see make_batch
  std::vector<MaterialId> materials;
  size_t threshold_count = 0, check_count = 0;
  // For error diffusion, which needs all fractions: only what is outside counts as settled.
  bool settles_outside_only = false;

  // The material that all voxels of a region get in which outputs are within these ranges; 0 where
  // nothing is inside, nothing where that is not settled.
  std::optional<MaterialId> settled(const program::Program& program, const std::vector<Interval>& ranges) const;
};

// Without `batch`, which is made from `reference` once its reads have their tags.
Selector make_selector(const MaterialProgram& materials, Dither dither);
void make_batch(Selector& selector);

}  // namespace ombre::voxel
