// Evaluators of the voxels of tiles where intervals do not suffice: the reference, or float batches.
#pragma once

#include <memory>

#include "eval/batch/kernels.h"
#include "voxel/blue_noise.h"
#include "voxel/dither.h"
#include "voxel/selector.h"
#include "voxel/tile.h"

namespace ombre::voxel {

// All data on which the voxels of a job depend.
struct VoxelJob {
  Selector selector;
  Lattice lattice;
  Dither dither = Dither::stochastic;
  uint64_t seed = 0;
  const uint32_t* noise = blue_noise_mask(lattice.pitch[0], lattice.pitch[1]);
};

// Evaluates tiles on one thread. `program` is the selector's program specialised to the tile, and `ranges` are the
// values' ranges there.
class LeafEvaluator {
 public:
  virtual ~LeafEvaluator() = default;
  // True if it evaluates the program's many parts itself; if false, they must be replaced by their code first.
  virtual bool takes_parts(const program::Program&) const { return false; }
  virtual void evaluate(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile,
                        const StripSources& sources, StripVoxels& voxels) = 0;
};

// Returns an evaluator in double precision that computes one op at a time.
std::unique_ptr<LeafEvaluator> reference_leaf(const VoxelJob& job);
// Returns an evaluator with floats. Voxels whose values exceed floats are evaluated by the reference.
std::unique_ptr<LeafEvaluator> batch_leaf(const VoxelJob& job, const eval::KernelSet& kernels);

}  // namespace ombre::voxel
