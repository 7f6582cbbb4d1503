// Layers that differ from what their design gives, and why they may.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "jobs/stacks/design_voxels.h"
#include "jobs/stacks/shown_layer.h"

namespace ombre::compile {

// A layer with voxels that its design does not give.
struct LayerDifference {
  int64_t layer = 0;
  std::vector<size_t> voxels;  // numbers of voxels of the layer, ascending
  Finding finding;             // what is to be said of them
};

// A cause that explains a difference.
struct LikelyCause {
  std::string kind, text;
};

// Returns what a whole layer must show.
using ExpectedLayer = std::function<Shown(int64_t layer)>;

// Appearance for a cause: the layer is mirrored, it shows one of these other layers, or it is dithered anew. `expected`
// is what it must show; `changes` is the number of voxels that other draws are expected to change.
LikelyCause likely_cause(const Shown& shown, const Shown& expected, int64_t width,
                         const std::vector<int64_t>& other_layers, const ExpectedLayer& expected_layer, double changes);

}  // namespace ombre::compile
