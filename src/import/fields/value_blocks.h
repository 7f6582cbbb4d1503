// The least and the greatest value of blocks of voxels, as a pyramid.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/math/interval.h"

namespace ombre::importing {

using VoxelCorner = std::array<int64_t, 3>;

class ValueBlocks {
 public:
  // Constructs the pyramid; row_range(j, k, first, end) returns the range of the voxels [first, end) of a row.
  template <class RowRange>
  ValueBlocks(const VoxelCorner& count, const RowRange& row_range) : edge_(edge_for(count)) {
    Level& finest = levels_.emplace_back(blocks_of(count, edge_));
    for (int64_t k = 0; k < count[2]; ++k)
      for (int64_t j = 0; j < count[1]; ++j)
        for (int64_t i = 0; i < count[0]; i += edge_)
          finest.add({i / edge_, j / edge_, k / edge_}, row_range(j, k, i, std::min(i + edge_, count[0])));
    while (levels_.back().ranges.size() > 1) levels_.push_back(coarser(levels_.back()));
  }

  int64_t edge() const { return edge_; }  // side of the smallest blocks, in voxels
  const Interval& whole() const { return levels_.back().ranges[0]; }

  // Returns the range of voxels lo to hi, both included, which must lie in the grid.
  Interval over(VoxelCorner lo, VoxelCorner hi) const {
    constexpr int64_t few = 4;
    const auto halve = [&](int64_t by) {
      for (size_t axis = 0; axis < 3; ++axis) {
        lo[axis] /= by;
        hi[axis] /= by;
      }
    };
    halve(edge_);
    size_t level = 0;
    for (; std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]}) >= few; ++level) halve(2);
    Interval found = levels_[level].at(lo);
    for (int64_t k = lo[2]; k <= hi[2]; ++k)
      for (int64_t j = lo[1]; j <= hi[1]; ++j)
        for (int64_t i = lo[0]; i <= hi[0]; ++i) found = both(found, levels_[level].at({i, j, k}));
    return found;
  }

  // Calls visit with the first voxel of each smallest block whose range meets the interval.
  template <class Visit>
  void each_with(const Interval& values, const Visit& visit) const {
    const Level& finest = levels_.front();
    for (int64_t k = 0; k < finest.count[2]; ++k)
      for (int64_t j = 0; j < finest.count[1]; ++j)
        for (int64_t i = 0; i < finest.count[0]; ++i) {
          const Interval& range = finest.at({i, j, k});
          if (range.lo <= values.hi && range.hi >= values.lo) visit(VoxelCorner{i * edge_, j * edge_, k * edge_});
        }
  }

  size_t bytes() const {
    size_t ranges = 0;
    for (const Level& level : levels_) ranges += level.ranges.size();
    return ranges * sizeof(Interval);
  }

 private:
  struct Level {
    VoxelCorner count;
    std::vector<Interval> ranges;

    explicit Level(const VoxelCorner& size)
        : count(size), ranges(static_cast<size_t>(size[0] * size[1] * size[2]), nothing()) {}
    size_t index(const VoxelCorner& at) const {
      return static_cast<size_t>((at[2] * count[1] + at[1]) * count[0] + at[0]);
    }
    const Interval& at(const VoxelCorner& block) const { return ranges[index(block)]; }
    void add(const VoxelCorner& block, const Interval& range) {
      Interval& mine = ranges[index(block)];
      mine = both(mine, range);
    }
  };

  // Returns the side of the smallest blocks; it is larger for large grids, so that blocks need little memory compared
  // with the voxels.
  static int64_t edge_for(const VoxelCorner& count) {
    constexpr double many = 1e9;
    constexpr int64_t small = 4, large = 16;
    return static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]) > many ? large
                                                                                                                : small;
  }

  static Interval nothing() {
    Interval none = Interval::everything();
    std::swap(none.lo, none.hi);
    return none;
  }
  static Interval both(const Interval& a, const Interval& b) {
    Interval sum = a;
    sum.lo = std::min(a.lo, b.lo);
    sum.hi = std::max(a.hi, b.hi);
    return sum;
  }
  static VoxelCorner blocks_of(const VoxelCorner& count, int64_t size) {
    return {(count[0] + size - 1) / size, (count[1] + size - 1) / size, (count[2] + size - 1) / size};
  }
  static Level coarser(const Level& fine) {
    Level level(blocks_of(fine.count, 2));
    for (int64_t k = 0; k < fine.count[2]; ++k)
      for (int64_t j = 0; j < fine.count[1]; ++j)
        for (int64_t i = 0; i < fine.count[0]; ++i) level.add({i / 2, j / 2, k / 2}, fine.at({i, j, k}));
    return level;
  }

  int64_t edge_;
  std::vector<Level> levels_;
};

}  // namespace ombre::importing
