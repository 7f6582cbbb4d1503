// Evaluates outputs of a program as numbers on a voxel lattice, tile by tile.
#pragma once

#include <memory>
#include <vector>

#include "base/system/progress.h"
#include "voxel/evaluator.h"
#include "voxel/tile.h"

namespace ombre::voxel {

// What the outputs are in a box of voxels: where it is uniform one number for each, else one for each
// output and voxel, output after output, x fastest, then y, then z.
struct FieldTile {
  TileBox box;
  bool is_uniform = false;
  std::vector<float> values;

  const float* output(size_t n) const {
    return values.data() + n * (is_uniform ? 1 : static_cast<size_t>(box.voxels()));
  }
};

// Thread-safe. What floats cannot hold is computed in double precision; what is no number there is NaN.
class FieldEvaluator {
 public:
  // `program` without calls.
  FieldEvaluator(program::Program program, const Lattice& lattice, Evaluator evaluator);
  ~FieldEvaluator();

  // Tiles that fill the region together; no value depends on the region. Throws Cancelled soon after it is
  // asked to stop.
  std::vector<FieldTile> tiles(const TileBox& region, const StopFlag* stop = nullptr) const;

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace ombre::voxel
