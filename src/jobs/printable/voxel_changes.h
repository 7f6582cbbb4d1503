// Changes of a job's voxels, as runs of new materials.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "jobs/printable/bit_layer.h"
#include "jobs/printable/layer_windows.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

// Voxels [begin, end) of row j become a material; 0 is void.
struct ChangedRun {
  int64_t j = 0, begin = 0, end = 0;
  MaterialId to = 0;
};

// Runs do not overlap. They may lie outside the job's lattice, which then grows.
class VoxelChanges {
 public:
  void add(int64_t k, const ChangedRun& run);
  // Changes the voxels with flags, whose layer has a margin around the lattice.
  void add(int64_t k, const BitLayer& flags, int64_t margin, MaterialId to);

  bool is_empty() const { return layers_.empty(); }
  const IndexBox& box() const { return box_; }  // around all changed voxels
  const std::map<int64_t, std::vector<ChangedRun>>& layers() const { return layers_; }

 private:
  std::map<int64_t, std::vector<ChangedRun>> layers_;
  IndexBox box_;
};
using VoxelChangesPtr = std::shared_ptr<const VoxelChanges>;

// Returns a plan of the job with the changes. It gives whole layers only, by its producer.
Plan changed_plan(const Plan& plan, const VoxelChangesPtr& changes);

// Returns how many voxels each material gains by the changes of a plan, less those that it loses; without void.
std::map<MaterialId, int64_t> gained_voxels(const Plan& plan, const VoxelChanges& changes, const CheckRun& run);

}  // namespace ombre::compile
