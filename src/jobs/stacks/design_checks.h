// Checks a stack with its design: voxels are evaluated again, by the reference.
#pragma once

#include <string>
#include <vector>

#include "jobs/stacks/design_voxels.h"
#include "jobs/stacks/layer_samples.h"
#include "jobs/stacks/stack_checks.h"

namespace ombre::compile {

struct DesignCheck {
  uint64_t voxels = 0;    // evaluated again
  uint64_t rounded = 0;   // of these, those that differ within rounding of a boundary
  uint64_t diffused = 0;  // of these, those to which diffusion passed on what was rounded before them
  uint64_t windows = 0;   // in which fractions were compared
  int64_t layers = 0;     // looked at
  Findings findings;
  std::vector<FindingPicture> pictures;
  std::vector<std::string> unchecked;
};

// Compares samples of some layers of the stack with the design. Returns nothing, and adds diagnostics, if the design is
// wrong. Throws Cancelled.
std::optional<DesignCheck> check_design(const Stack& stack, const LayerReader& reader, const LoadedPtr& loaded,
                                        LayerRange layers, const SampleChoice& choice, const CheckWork& work,
                                        Diagnostics& diagnostics);

}  // namespace ombre::compile
