#include "voxel/tile_points.h"

namespace ombre::voxel {

void TilePoints::place(const Lattice& lattice, const TileBox& tile) {
  lo_ = tile.lo;
  const auto centers = [&](size_t axis, std::vector<float>& values) {
    values.resize(static_cast<size_t>(tile.hi[axis] - tile.lo[axis]));
    for (size_t n = 0; n < values.size(); ++n)
      values[n] = static_cast<float>(lattice.center(axis, tile.lo[axis] + static_cast<int64_t>(n)));
  };
  centers(0, xs_);
  centers(1, ys_);
  centers(2, zs_);
  width_ = xs_.size();
  xs_.resize(width_ + eval::batch_lanes, xs_.back());
}

}  // namespace ombre::voxel
