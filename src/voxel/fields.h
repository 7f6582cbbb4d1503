// Evaluates outputs of a program as numbers on a voxel lattice, tile by tile.
#pragma once

#include <memory>
#include <vector>

#include "base/system/progress.h"
#include "voxel/evaluator.h"
#include "voxel/tile.h"

namespace ombre::voxel {

// The outputs in a box of voxels. If the box is uniform, there is one number for each output; else there is one for
// each output and voxel, output after output, with x varying fastest, then y, then z.
struct FieldTile {
  TileBox box;
  bool is_uniform = false;
  std::vector<float> values;

  const float* output(size_t n) const {
    return values.data() + n * (is_uniform ? 1 : static_cast<size_t>(box.voxels()));
  }
};

// Thread-safe. Values beyond the range of floats are computed in double precision. Values that are undefined there,
// too, are NaN.
class FieldEvaluator {
 public:
  // `program` may not hold calls.
  FieldEvaluator(program::Program program, const Lattice& lattice, Evaluator evaluator);
  ~FieldEvaluator();

  // Returns tiles that fill the region. Values do not depend on the region. Throws Cancelled soon after a stop is
  // requested.
  std::vector<FieldTile> tiles(const TileBox& region, const StopFlag* stop = nullptr) const;

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace ombre::voxel
