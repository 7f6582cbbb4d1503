// What evaluates the voxels of tiles that intervals cannot settle: the reference, or float batches.
#pragma once

#include <memory>

#include "eval/batch/kernels.h"
#include "voxel/blue_noise.h"
#include "voxel/dither.h"
#include "voxel/selector.h"
#include "voxel/tile.h"

namespace ombre::voxel {

// Everything that the voxels of a job depend on.
struct VoxelJob {
  Selector selector;
  Lattice lattice;
  Dither dither = Dither::stochastic;
  uint64_t seed = 0;
  const uint32_t* noise = blue_noise_mask(lattice.pitch[0], lattice.pitch[1]);
};

// One thread's evaluator. `program` is what is left of the selector's in a tile, `ranges` its values there.
class LeafEvaluator {
 public:
  virtual ~LeafEvaluator() = default;
  // Does it evaluate the program's many parts by itself? If not, they are written out before.
  virtual bool takes_parts(const program::Program&) const { return false; }
  virtual void evaluate(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile,
                        const StripSources& sources, StripVoxels& voxels) = 0;
};

// Double precision, one op at a time.
std::unique_ptr<LeafEvaluator> reference_leaf(const VoxelJob& job);
// Floats. Voxels whose values floats cannot hold are evaluated by the reference.
std::unique_ptr<LeafEvaluator> batch_leaf(const VoxelJob& job, const eval::KernelSet& kernels);

}  // namespace ombre::voxel
