// Chooses the voxels of a stack that are evaluated again.
#pragma once

#include <cstdint>
#include <vector>

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

// Returns samples by ascending layers: all layers if they have few voxels, else whole layers and windows of others.
std::vector<LayerSample> choose_samples(const voxel::Lattice& lattice, const SampleChoice& choice);

}  // namespace ombre::compile
