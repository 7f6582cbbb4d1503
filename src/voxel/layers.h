// Evaluates a program on a voxel lattice, slab by slab, to runs of materials.
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

// Thread-safe; the result for a layer does not depend on how layers are grouped.
class LayerEvaluator {
 public:
  LayerEvaluator(const MaterialProgram& program, const Lattice& lattice, Dither dither, uint64_t seed,
                 const EvaluatorOptions& options = {});
  ~LayerEvaluator();

  // Layers [begin, end) of the lattice, lowest first. Works best on 4 to 16 at a time. Throws Cancelled soon
  // after it is asked to stop.
  std::vector<LayerResult> layers(int64_t begin, int64_t end, const StopFlag* stop = nullptr) const;
  // The same voxels as far as they lie in a box of the lattice, whose size decides the work (but for error diffusion,
  // which goes through whole layers). Counts and checks are those of the box; checks then of whole layers.
  std::vector<LayerResult> region(const TileBox& box, const StopFlag* stop = nullptr) const;

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

// The most that working on a slab takes beside its results.
size_t working_bytes(const Lattice& lattice, int64_t slab_layers, Dither dither, size_t material_count);

// Batches, unless this machine has no hardware multiply-add or floats cannot tell the lattice's voxels apart.
Evaluator best_evaluator(const Lattice& lattice);

}  // namespace ombre::voxel
