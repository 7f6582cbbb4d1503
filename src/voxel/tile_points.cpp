#include "voxel/tile_points.h"

namespace ombre::voxel {

void TilePoints::place(const Lattice& lattice, const TileBox& tile) {
  lo_ = tile.lo;
  const auto centers = [&](size_t axis, std::vector<float>& values) {
    values.clear();
    for (int64_t n = tile.lo[axis]; n < tile.hi[axis]; ++n)
      values.push_back(static_cast<float>(lattice.center(n, n, n)[static_cast<int>(axis)]));
  };
  centers(0, xs_);
  centers(1, ys_);
  centers(2, zs_);
  width_ = xs_.size();
  xs_.resize(width_ + eval::batch_lanes, xs_.back());
}

}  // namespace ombre::voxel
