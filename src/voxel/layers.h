// Evaluates a program on a voxel lattice, slab by slab, and returns runs of materials.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "voxel/dither.h"
#include "voxel/evaluator.h"
#include "voxel/lattice.h"
#include "voxel/material_program.h"

namespace ombre::voxel {

// Thread-safe. The result for a layer does not depend on how layers are grouped.
class LayerEvaluator {
 public:
  LayerEvaluator(const MaterialProgram& program, const Lattice& lattice, Dither dither, uint64_t seed,
                 const EvaluatorOptions& options = {});
  ~LayerEvaluator();

  // Evaluates layers [begin, end) of the lattice, the lowest first. 4 to 16 layers at a time are most efficient. Throws
  // Cancelled soon after a stop is requested.
  std::vector<LayerResult> layers(int64_t begin, int64_t end, const StopFlag* stop = nullptr) const;
  // Evaluates the voxels of the same layers in a box of the lattice. Error diffusion evaluates whole layers, and its
  // checks cover them; otherwise the work, the counts and the checks are limited to the box.
  std::vector<LayerResult> region(const TileBox& box, const StopFlag* stop = nullptr) const;

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

// Returns the greatest amount of memory for a slab, without its results.
size_t working_bytes(const Lattice& lattice, int64_t slab_layers, Dither dither, size_t material_count);

// Returns the batch evaluator, unless this machine has no hardware multiply-add or floats cannot resolve the lattice's
// voxels.
Evaluator best_evaluator(const Lattice& lattice);

}  // namespace ombre::voxel
