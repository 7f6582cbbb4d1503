// Chooses the voxels of a stack that are evaluated again.
#pragma once

#include <cstdint>
#include <vector>

#include "jobs/common/layer_range.h"
#include "jobs/slice/layer.h"

namespace ombre::compile {

struct SampleChoice {
  bool all = false;
  double voxels = 2e7;                // the most, apart from layers at borders
  uint64_t seed = 0;                  // decides which
  std::vector<int64_t> borders = {};  // first layers of shares; they, and those below them, are taken whole
  bool whole_layers = false;          // no windows, where a window costs as much as its layer
};

// Windows of a layer that do not lie over each other.
struct LayerSample {
  int64_t layer = 0;
  std::vector<LayerWindow> windows;
};

// Returns samples of some layers of a lattice, by ascending layers: all of them if they have few voxels, else whole
// layers and windows of others.
std::vector<LayerSample> choose_samples(const voxel::Lattice& lattice, LayerRange layers, const SampleChoice& choice);

}  // namespace ombre::compile
