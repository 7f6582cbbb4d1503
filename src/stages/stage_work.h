// The state that all stages of a job share.
#pragma once

#include <atomic>
#include <cstddef>

#include "base/system/progress.h"
#include "design/sub_design_memory.h"
#include "stages/block_cache.h"
#include "stages/stage_keeper.h"

namespace ombre::compile {

// The threads, memory, progress and stop flag that a job lends to its stages.
struct StageLoan {
  int threads = 0;                        // 0: all cores
  size_t memory_bytes = size_t{2} << 30;  // memory of the whole job
  Progress* progress = nullptr;
  const StopFlag* stop = nullptr;  // must live as long as the job works
  // Memory that keeps values for other jobs; null: values are not kept. It must live as long as the job's stages.
  design::SubDesignMemory* memory = nullptr;
  bool keeps_blocks = false;      // keeps values of halo stages, too; there are many if all layers are made
  StageKeeper* keeper = nullptr;  // keeps values of stages that are computed as a whole for later runs; may be null
};

// State that halo stages share. They may be computed at any time, by any of the job's threads.
struct SharedStageWork {
  BlockCache blocks;
  std::atomic<const StopFlag*> stop{nullptr};
  std::atomic<int> threads{0};
  std::atomic<bool> is_under_way{false};  // true once the job has been planned and makes layers
  std::atomic<size_t> memory_bytes{size_t{2} << 30};
  std::atomic<design::SubDesignMemory*> memory{nullptr};
  std::atomic<bool> keeps_blocks{false};
};

}  // namespace ombre::compile
