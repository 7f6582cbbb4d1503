#include "voxel/tile_traversal.h"

#include <algorithm>
#include <bit>

#include "program/evaluate.h"
#include "program/passes/passes.h"
#include "program/passes/replay.h"

namespace ombre::voxel {
namespace {

// Costs relative to one op on one voxel in a batch: starting an op on a row, evaluating an op on intervals and copying
// it to a shorter program, drawing, and choosing among one more material.
constexpr double row_cost = 60, question_cost = 500, draw_cost = 12, choice_cost = 3;
// Intervals are evaluated once in this many tiles of a size where they did not pay.
constexpr uint32_t patience = 32;
constexpr double memory = 0.9;  // weight of earlier tiles in the average gain

size_t level_of(const TileBox& tile) {
  return static_cast<size_t>(std::bit_width(static_cast<uint64_t>(tile.voxels())));
}

}  // namespace

void TileTraversal::run(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& strip,
                        const StripSources& sources, StripVoxels& voxels) {
  sources_ = &sources;
  voxels_ = &voxels;
  descend(program, ranges, strip);
}

bool TileTraversal::is_small(const program::Program& program, const TileBox& tile) const {
  const bool is_long = is_long_program(program);
  return tile.size(0) <= (is_long ? options_.small_leaf_width : options_.leaf_width) &&
         tile.size(1) <= (is_long ? options_.small_leaf_height : options_.leaf_height);
}

// Returns the number of ops per voxel. Ops per row or column are not counted, since they cost little.
size_t TileTraversal::voxel_ops(const program::Program& program) {
  const std::vector<uint8_t> masks = program::axis_masks(program);
  auto ops = static_cast<double>(std::count(masks.begin(), masks.end(), uint8_t{7}));
  for (const program::Read& read : program.reads) ops += read.source->ops_of_sample(read.channel) - 1;
  return static_cast<size_t>(ops);
}

// True if evaluating intervals over the tile is likely to save more than it costs.
bool TileTraversal::pays(const program::Program& program, const TileBox& tile) {
  if (!options_.prune) return false;
  if (must_cut(tile)) return true;
  Gain& gain = gains_[level_of(tile)];
  const double choices = draw_cost + choice_cost * static_cast<double>(program.outputs.size());
  const double ops = static_cast<double>(voxel_ops(program)) + choices;
  const double rows = static_cast<double>(tile.size(1) * tile.size(2));
  const double work = ops * (static_cast<double>(tile.voxels()) + rows * row_cost);
  if (gain.share * work > static_cast<double>(program.code.size()) * question_cost || ++gain.skipped >= patience) {
    gain.skipped = 0;
    return true;
  }
  return false;
}

void TileTraversal::descend(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile) {
  if (program.has_parts() || pays(program, tile)) return ask(program, tile);
  if (must_cut(tile)) return cut(program, ranges, tile);
  leaf_.evaluate(program, ranges, tile, *sources_, *voxels_);
}

void TileTraversal::ask(const program::Program& program, const TileBox& tile) {
  std::vector<Interval> values;
  evaluate_intervals(program, centers(job_.lattice, tile), values, sources_->ranges(tile), precision_);
  const auto settled = job_.selector.settled(program, values);
  Gain& gain = gains_[level_of(tile)];
  if (settled) {
    gain.share = memory * gain.share + (1 - memory);
    if (*settled != 0) voxels_->fill(tile, *settled);
    return;
  }
  std::vector<Interval> kept;
  const program::Program shorter = program::shorten(program, values, &kept);
  if (shorter.has_parts()) {
    if (must_cut(tile)) return cut(shorter, kept, tile);
    if (!options_.write_parts_out && leaf_.takes_parts(shorter))
      return leaf_.evaluate(shorter, kept, tile, *sources_, *voxels_);
    const bool few = parts_in_reach(shorter, kept, options_.many_parts) < options_.many_parts;
    if (!few && !is_small(shorter, tile)) return cut(shorter, kept, tile);
    return ask(program::expand_parts(shorter, kept, precision_), tile);
  }
  const double left = static_cast<double>(shorter.code.size()) / static_cast<double>(program.code.size());
  gain.share = memory * gain.share + (1 - memory) * std::max(0.0, 1 - left);
  if (is_small(shorter, tile)) return leaf_.evaluate(shorter, kept, tile, *sources_, *voxels_);
  cut(shorter, kept, tile);
}

// Halves the tile along its longer side, measured in leaf tiles.
void TileTraversal::cut(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile) {
  const bool is_long = is_long_program(program);
  const int64_t width = is_long ? options_.small_leaf_width : options_.leaf_width;
  const int64_t height = is_long ? options_.small_leaf_height : options_.leaf_height;
  const size_t axis = tile.size(0) * height > tile.size(1) * width ? 0 : 1;
  const int64_t unit = axis == 0 ? width : height;
  const int64_t units = (tile.size(static_cast<int>(axis)) + unit - 1) / unit;
  TileBox low = tile, high = tile;
  low.hi[axis] = high.lo[axis] = tile.lo[axis] + (units / 2) * unit;
  descend(program, ranges, low);
  descend(program, ranges, high);
}

}  // namespace ombre::voxel
