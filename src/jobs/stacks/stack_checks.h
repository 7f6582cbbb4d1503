// Checks a stack by itself: its files beside its journal, its images beside its job.json.
#pragma once

#include <string>
#include <vector>

#include "base/system/progress.h"
#include "jobs/common/layer_range.h"
#include "jobs/stacks/shown_layer.h"
#include "jobs/stacks/stack.h"

namespace ombre::compile {

// Threads and memory that a check may use. Progress and stop flag may be null.
struct CheckWork {
  int threads = 0;  // 0: all cores
  size_t memory_bytes = size_t{2} << 30;
  Progress* progress = nullptr;
  const StopFlag* stop = nullptr;
};

// Returns the work with as many threads as layers of a lattice fit into its memory, at least one.
CheckWork fitting(CheckWork work, const voxel::Lattice& lattice);

struct StackCheck {
  int64_t layers = 0;  // layers whose images were read, or that need none
  uint64_t files = 0, bytes = 0;
  Findings findings;
  std::vector<std::string> unchecked;  // what could not be checked, each as a sentence without a full stop
};

// Reads all images of some layers of the stack. Totals are compared if these are all layers. Throws Cancelled.
StackCheck check_stack(const Stack& stack, LayerRange layers, const LayerReader& reader, const CheckWork& work);

// Returns what the images of one layer show, channel by channel; nothing if they are not there or cannot be read.
std::optional<std::vector<Shown>> read_layer(const Stack& stack, const LayerReader& reader, int64_t layer);

}  // namespace ombre::compile
