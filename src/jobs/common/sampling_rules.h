// The rules by which points become voxels: options, apart from the lattice, that decide the voxels of a job.
#pragma once

#include "options/option.h"
#include "voxel/layers.h"

namespace ombre::compile {

// The rules, each of which job.json holds.
struct SamplingRules {
  voxel::Dither dither = voxel::Dither::stochastic;
  voxel::Evaluator evaluator = voxel::Evaluator::batch;
  uint64_t seed = 0;

  static const options::Spec<SamplingRules>& options() {
    using namespace options;
    static const options::Spec<SamplingRules> spec{
        choice("--dither", &SamplingRules::dither, voxel::dither_names(),
               "How a mixture becomes one material a voxel: stochastic (default), blue-noise, diffusion or threshold",
               "MODE"),
        choice("--evaluator", &SamplingRules::evaluator, voxel::evaluator_names(),
               "How values are computed: batch (default, floats, fast) or reference (double precision, slow)", "NAME"),
        option("--seed", &SamplingRules::seed, kind::seed,
               "Seed of the dithering (default 0); equal seeds give equal files", "N")};
    return spec;
  }
};

}  // namespace ombre::compile
