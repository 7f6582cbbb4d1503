#include "voxel/layer_points.h"

namespace ombre::voxel {

void LayerPoints::place(const Lattice& lattice, const TileBox& tile) {
  width_ = static_cast<size_t>(tile.size(0));
  rows_ = static_cast<size_t>(tile.size(1));
  stride_ = (width_ + eval::batch_lanes - 1) / eval::batch_lanes * eval::batch_lanes;
  xs_.clear();
  ys_.clear();
  zs_.clear();
  for (int64_t i = tile.lo[0]; i < tile.hi[0]; ++i) xs_.push_back(static_cast<float>(lattice.center(i, 0, 0).x));
  xs_.resize(stride_, xs_.back());
  xs_.resize(stride_ * rows_);
  for (size_t j = 1; j < rows_; ++j)
    std::copy_n(xs_.begin(), stride_, xs_.begin() + static_cast<ptrdiff_t>(j * stride_));
  for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j)
    ys_.insert(ys_.end(), stride_, static_cast<float>(lattice.center(0, j, 0).y));
  for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k) zs_.push_back(static_cast<float>(lattice.center(0, 0, k).z));
}

}  // namespace ombre::voxel
