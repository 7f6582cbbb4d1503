// The centres of a tile's voxels, as floats.
#pragma once

#include <vector>

#include "eval/batch/batch.h"
#include "voxel/tile.h"

namespace ombre::voxel {

// The voxel at which a row of points begins.
struct RowPlace {
  int64_t i = 0, j = 0;
};

class TilePoints {
 public:
  void place(const Lattice& lattice, const TileBox& tile);
  eval::BoxPoints all() const { return {{xs_.data(), width_}, ys_, zs_}; }
  // Returns a row within the tile, of any width.
  eval::PointRow row(RowPlace at) const {
    return {xs_.data() + (at.i - lo_[0]), ys_[static_cast<size_t>(at.j - lo_[1])]};
  }
  std::span<const float> layers(int64_t begin, int64_t end) const {
    return {zs_.data() + (begin - lo_[2]), static_cast<size_t>(end - begin)};
  }

 private:
  std::array<int64_t, 3> lo_{};
  size_t width_ = 0;
  std::vector<float> xs_, ys_, zs_;  // xs_ is padded at the end
};

}  // namespace ombre::voxel
