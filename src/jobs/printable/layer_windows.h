// Takes the layers of a job, with as many around them as a computation reads, from the lowest to the highest.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "jobs/printable/bit_layer.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

// Layers of a job as flags, with a margin of void around them along x and y.
struct SolidLayers {
  BitLayers solid;
  std::map<MaterialId, BitLayers> of_material;  // of those that are asked for
  // The materials of the layers of `solid`, without margin; null: void. Empty unless they are asked for.
  std::vector<std::shared_ptr<const RunLayer>> voxels = {};
};

struct WindowShape {
  int64_t reach = 0;   // layers that a computation reads below and above those that it computes
  int64_t beyond = 1;  // layers of void below and above the job that are computed, too
  std::vector<MaterialId> materials = {};
  bool has_voxels = false;

  int64_t margin() const { return reach + beyond; }  // of flags along x and y, too
};

struct CheckRun {
  int threads = 0;
  size_t memory_bytes = size_t{2} << 30;
  Progress* progress = nullptr;
  const StopFlag* stop = nullptr;
};

// Calls `take` with layers [begin, end) of the job, and `reach` layers around them. The windows follow each other, and
// what is in them depends on neither threads nor memory, but their sizes do. The plan's stages must be prepared. Throws
// Cancelled.
using TakeWindow = std::function<void(const SolidLayers& layers, int64_t begin, int64_t end)>;
void each_window(const Plan& plan, const WindowShape& shape, const CheckRun& run, const TakeWindow& take);

}  // namespace ombre::compile
