// The centres of a narrow tile's voxels, a layer in a row (eval::BoxLayers).
#pragma once

#include <vector>

#include "eval/batch/batch.h"
#include "voxel/row_kernels.h"
#include "voxel/tile.h"

namespace ombre::voxel {

class LayerPoints {
 public:
  void place(const Lattice& lattice, const TileBox& tile);
  // Evaluates a program over the placed tile; take_layer(k) for the layers, counted from the tile's lowest,
  // where output 0 is not 0 everywhere.
  template <class TakeLayer>
  void evaluate(eval::BatchEvaluator& batch, const RowKernels& kernels, const program::Program& program,
                const std::vector<Interval>& ranges, const eval::SourceRows& sources, TakeLayer take_layer) const {
    batch.begin(program, ranges, layers(), sources);
    for (size_t k = 0; k < zs_.size(); ++k) {
      batch.begin_layer(k);
      batch.begin_row(0);
      if (!kernels.any(batch.output(0), xs_.size())) continue;
      batch.finish_row();
      take_layer(static_cast<int64_t>(k));
    }
  }
  // The part of a layer's values that belongs to one row of the tile.
  eval::Values row(const eval::Values& values, size_t j) const {
    return values.is_number ? values : eval::Values{values.row + j * stride_, false};
  }

 private:
  eval::BoxLayers layers() const { return {xs_, ys_, zs_, width_, rows_}; }

  size_t width_ = 0, rows_ = 0, stride_ = 0;
  std::vector<float> xs_, ys_, zs_;
};

}  // namespace ombre::voxel
