// The rules by which points become voxels: what people choose of a job that decides its voxels, beside the lattice.
#pragma once

#include "options/option.h"
#include "voxel/layers.h"

namespace ombre::compile {

// job.json holds each of them.
struct SamplingRules {
  voxel::Dither dither = voxel::Dither::stochastic;
  voxel::Evaluator evaluator = voxel::Evaluator::batch;
  uint64_t seed = 0;

  static const options::Spec<SamplingRules>& options();
};

}  // namespace ombre::compile
