// The centres of a narrow tile's voxels, a layer in a row (eval::BoxLayers).
#pragma once

#include <vector>

#include "eval/batch/batch.h"
#include "voxel/tile.h"

namespace ombre::voxel {

class LayerPoints {
 public:
  void place(const Lattice& lattice, const TileBox& tile);
  eval::BoxLayers layers() const { return {xs_, ys_, zs_, width_, rows_}; }
  size_t count() const { return xs_.size(); }  // of a layer, with padding
  // The part of a layer's values that belongs to one row of the tile.
  eval::Values row(const eval::Values& values, size_t j) const {
    return values.is_number ? values : eval::Values{values.row + j * stride_, false};
  }

 private:
  size_t width_ = 0, rows_ = 0, stride_ = 0;
  std::vector<float> xs_, ys_, zs_;
};

}  // namespace ombre::voxel
