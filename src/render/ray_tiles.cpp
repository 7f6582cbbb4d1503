#include "render/ray_tiles.h"

#include <cmath>

namespace ombre::render {
namespace {

int64_t units(int64_t size, int64_t unit) { return (size + unit - 1) / unit; }

// Returns the number of pieces per level such that a few equal levels lead to the units.
int64_t wanted_pieces(int64_t all_units) {
  int64_t levels = 1;
  while (std::pow(most_pieces, levels) < static_cast<double>(all_units)) ++levels;
  return static_cast<int64_t>(std::ceil(std::pow(static_cast<double>(all_units), 1.0 / static_cast<double>(levels))));
}

}  // namespace

std::vector<TileBox> cut(const TileBox& tile, const TileSize& unit) {
  TileSize length{}, counts{1, 1, 1};
  for (size_t axis = 0; axis < 3; ++axis) length[axis] = units(tile.size(static_cast<int>(axis)), unit[axis]);
  const int64_t wanted = wanted_pieces(length[0] * length[1] * length[2]);
  const TileSize all = length;
  for (int64_t count = 1; count < wanted && 2 * count <= most_pieces; count *= 2) {
    const auto axis = static_cast<size_t>(std::max_element(length.begin(), length.end()) - length.begin());
    if (length[axis] == 1) break;
    counts[axis] *= 2;
    length[axis] = units(all[axis], counts[axis]);
  }
  std::vector<TileBox> pieces{tile};
  for (const size_t axis : {size_t{0}, size_t{1}, size_t{2}}) {
    std::vector<TileBox> cut_again;
    for (TileBox piece : pieces) {
      for (int64_t begin = tile.lo[axis]; begin < tile.hi[axis]; begin = piece.hi[axis]) {
        piece.lo[axis] = begin;
        piece.hi[axis] = std::min(begin + length[axis] * unit[axis], tile.hi[axis]);
        cut_again.push_back(piece);
      }
    }
    pieces = std::move(cut_again);
  }
  return pieces;
}

TileBox fine_box(const TileBox& tile) {
  TileBox fine = tile;
  fine.lo[0] = RaySteps::fine_of(tile.lo[0] - 1);
  fine.hi[0] = RaySteps::fine_of(tile.hi[0] - 1) + 1;
  return fine;
}

void TileIntervals::evaluate(const program::Program& program, std::vector<TileBox> fine,
                             const voxel::StripSources& sources) {
  fine_ = std::move(fine);
  boxes_.clear();
  const Film& film = steps_.film;
  for (const TileBox& tile : fine_)
    boxes_.push_back({{steps_.depth(tile.lo[0]), film.right_of(tile.lo[1]), film.down_of(tile.lo[2])},
                      {steps_.depth(tile.hi[0] - 1), film.right_of(tile.hi[1] - 1), film.down_of(tile.hi[2] - 1)}});
  using Place = eval::BoxIntervals::Place;
  intervals_.evaluate(program, boxes_, [&](const program::Read& read, const Place& at, eval::IntervalRow to) {
    for (size_t box = 0; box < fine_.size(); ++box) {
      const Interval range =
          sources.has(read.tag) ? sources.range(read.tag, fine_[box]) : read.source->range(read.channel, at.in(box));
      to.lo[box] = static_cast<float>(range.lo);
      to.hi[box] = static_cast<float>(range.hi);
    }
  });
}

}  // namespace ombre::render
