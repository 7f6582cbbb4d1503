// Boxes of samples of rays, in steps, columns and rows.
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
// Cuts a tile into pieces whose sizes are multiples of `unit`, except the last ones; the nearest come first. Each level
// has about the same number of pieces, at most `most_pieces`, until pieces are units.
std::vector<TileBox> cut(const TileBox& tile, const TileSize& unit);

// Returns a tile in fine steps, with a margin: refined samples lie up to a step before a tile's first.
TileBox fine_box(const TileBox& tile);

// The intervals of a program over many tiles at once.
class TileIntervals {
 public:
  explicit TileIntervals(const RaySteps& steps) : steps_(steps), intervals_(eval::kernel_sets().front()) {}

  // Evaluates tiles, given in fine steps. The program must outlive the calls below.
  void evaluate(const program::Program& program, std::vector<TileBox> fine, const voxel::StripSources& sources);
  Interval output(size_t n, size_t tile) const { return intervals_.output(n, tile); }
  // Returns the interval of each instruction in one tile, or its hull over several tiles.
  void values(size_t tile, std::vector<Interval>& values) const { intervals_.values(tile, values); }
  void values(std::span<const size_t> tiles, std::vector<Interval>& values) { intervals_.values(tiles, values); }

 private:
  const RaySteps& steps_;
  eval::BoxIntervals intervals_;
  std::vector<TileBox> fine_;
  std::vector<Box> boxes_;
};

}  // namespace ombre::render
