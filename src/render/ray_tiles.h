// Boxes of samples of rays: steps, columns, rows.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "eval/batch/box_intervals.h"
#include "render/ray_steps.h"
#include "voxel/tile.h"

namespace ombre::render {

using voxel::TileBox;
using TileSize = std::array<int64_t, 3>;

constexpr int64_t most_pieces = 64;
// Pieces of a tile whose sizes are multiples of `unit`, but for the last ones; the nearest first. About the same
// number at each level until the pieces are units, and at most `most_pieces`.
std::vector<TileBox> cut(const TileBox& tile, const TileSize& unit);

// In fine steps. Samples that look closer lie up to a step before a tile's first.
TileBox fine_box(const TileBox& tile);

// What a program says of many tiles at once.
class TileIntervals {
 public:
  explicit TileIntervals(const RaySteps& steps) : steps_(steps), intervals_(eval::kernel_sets().front()) {}

  // `fine` are in fine steps. The program outlives the questions.
  void evaluate(const program::Program& program, std::vector<TileBox> fine, const voxel::StripSources& sources);
  Interval output(size_t n, size_t tile) const { return intervals_.output(n, tile); }
  // Of each instruction: in one tile, or in any of some.
  void values(size_t tile, std::vector<Interval>& values) const { intervals_.values(tile, values); }
  void values(std::span<const size_t> tiles, std::vector<Interval>& values) { intervals_.values(tiles, values); }

 private:
  const RaySteps& steps_;
  eval::BoxIntervals intervals_;
  std::vector<TileBox> fine_;
  std::vector<Box> boxes_;
};

}  // namespace ombre::render
