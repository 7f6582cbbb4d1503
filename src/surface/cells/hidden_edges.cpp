#include "surface/cells/hidden_edges.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <optional>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "voxel/fields.h"
#include "voxel/layers.h"

namespace ombre::surface {
namespace {

using voxel::FieldTile;
using voxel::Lattice;
using voxel::TileBox;

constexpr uint8_t fine_level = grid_level - 2;
constexpr int32_t units = 1 << fine_level;            // distance between corners of finer cells, in units
constexpr int32_t per_cell = units_per_cell / units;  // number of finer cells along a side of a cell of the grid
constexpr int64_t fine_strip_layers = strip_layers * per_cell;
constexpr int64_t strip_rows = 64;  // number of rows of a strip whose labels are in memory at a time
constexpr size_t edges_at_once = size_t{1} << 18;

// Returns the lattice of corners of finer cells, which starts at the grid's first corner; null if its pitch is too
// small.
std::optional<Lattice> finer(const Lattice& corners) {
  Lattice finer;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Pitch pitch = corners.pitch[axis];
    const auto smaller = Pitch::from_ratio(pitch.numerator, pitch.denominator * per_cell);
    if (!smaller) return std::nullopt;
    finer.pitch[axis] = *smaller;
    finer.count[axis] = (corners.count[axis] - 1) * per_cell + 1;
    finer.origin[static_cast<int>(axis)] = corners.center(axis, 0) - smaller->times(0.5);
  }
  return finer;
}

// Searches a tile that is not uniform for crossed edges with both ends in it. Edges between tiles may be skipped: a
// border that crosses only those is much larger than a cell or crosses other edges too.
class TileEdges {
 public:
  TileEdges(const FieldTile& tile, const CellTree& tree) : tile_(tile), tree_(tree) {
    size_t count = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      first_cell_[axis] = static_cast<int32_t>(tile.box.lo[axis] / per_cell);
      cells_[axis] = static_cast<int32_t>((tile.box.hi[axis] - 1) / per_cell) - first_cell_[axis] + 1;
      count *= static_cast<size_t>(cells_[axis]);
    }
    known_.resize(count);
  }

  void search(std::vector<CrossedEdge>& edges) {
    for (int64_t k = 0; k < tile_.box.size(2); ++k)
      for (int64_t j = 0; j < tile_.box.size(1); ++j)
        for (size_t axis = 0; axis < 3; ++axis) search_row(j, k, axis, edges);
  }

 private:
  enum class Cell : uint8_t { unknown, in_sight, hidden };

  int64_t step(size_t axis) const {
    return axis == 0 ? 1 : axis == 1 ? tile_.box.size(0) : tile_.box.size(0) * tile_.box.size(1);
  }

  void search_row(int64_t j, int64_t k, size_t axis, std::vector<CrossedEdge>& edges) {
    if ((axis == 1 && j + 1 == tile_.box.size(1)) || (axis == 2 && k + 1 == tile_.box.size(2))) return;
    const float* const here = tile_.values.data() + j * step(1) + k * step(2);
    const float* const next = here + step(axis);
    const int64_t count = tile_.box.size(0) - (axis == 0);
    if (std::memcmp(here, next, static_cast<size_t>(count) * sizeof *here) == 0) return;
    for (int64_t i = 0; i < count; ++i)
      if (here[i] != next[i]) add({i, j, k}, axis, here[i], next[i], edges);
  }

  void add(const std::array<int64_t, 3>& at, size_t axis, float from, float to, std::vector<CrossedEdge>& edges) {
    CrossedEdge edge;
    size_t cell = 0;
    for (size_t a = 3; a-- > 0;) {
      edge.start[a] = static_cast<int32_t>(tile_.box.lo[a] + at[a]) * units;
      const auto along = static_cast<size_t>(edge.start[a] / units_per_cell - first_cell_[a]);
      cell = cell * static_cast<size_t>(cells_[a]) + along;
    }
    if (known_[cell] == Cell::unknown) known_[cell] = is_hidden(edge.start) ? Cell::hidden : Cell::in_sight;
    if (known_[cell] == Cell::in_sight) return;
    edge.axis = static_cast<uint8_t>(axis);
    edge.level = fine_level;
    edge.from = static_cast<Label>(from);
    edge.to = static_cast<Label>(to);
    edge.leaves.fill(CellTree::none);
    edges.push_back(edge);
  }

  // Returns true if the tree does not have the unit's cell of the grid. There are no cells beyond the last corners.
  bool is_hidden(const CellPlace& unit) const {
    for (size_t axis = 0; axis < 3; ++axis)
      if (unit[axis] >= (tree_.lattice().count[axis] - 1) * units_per_cell) return false;
    return tree_.find(unit) == CellTree::none;
  }

  const FieldTile& tile_;
  const CellTree& tree_;
  CellPlace first_cell_{}, cells_{};
  std::vector<Cell> known_;  // state of the grid's cells around the tile
};

}  // namespace

void hidden_edges_in(CellLayers layers, const program::Program& label, const CellTree& tree, int threads,
                     const StopFlag* stop, const TakeEdges& take) {
  const std::optional<Lattice> lattice = finer(tree.lattice());
  if (!lattice) return;
  const Lattice& fine = *lattice;
  const voxel::FieldEvaluator evaluator(label, fine, voxel::best_evaluator(fine));
  // The last corners lie behind the last layer.
  const bool is_last = layers.end == all_layers(tree.lattice()).end;
  const int64_t begin = layers.begin * per_cell, end = is_last ? fine.count[2] : layers.end * per_cell;
  std::atomic<bool> goes_on = true;
  run_ordered<std::vector<CrossedEdge>>(
      static_cast<size_t>((end - begin + fine_strip_layers - 1) / fine_strip_layers), threads,
      2 * static_cast<size_t>(threads > 0 ? threads : core_count()),
      [&](size_t n) {
        std::vector<CrossedEdge> edges;
        TileBox strip{{0, 0, begin + static_cast<int64_t>(n) * fine_strip_layers}, fine.count};
        strip.hi[2] = std::min(strip.lo[2] + fine_strip_layers, end);
        for (; goes_on && strip.lo[1] < fine.count[1]; strip.lo[1] += strip_rows) {
          strip.hi[1] = std::min(strip.lo[1] + strip_rows, fine.count[1]);
          for (const FieldTile& tile : evaluator.tiles(strip, stop))
            if (!tile.is_uniform) TileEdges(tile, tree).search(edges);
        }
        return edges;
      },
      [&](size_t, std::vector<CrossedEdge>& edges) {
        if (stop && stop->requested()) throw Cancelled();
        if (goes_on) goes_on = take(edges);
      });
}

bool EdgeBatches::add(const std::vector<CrossedEdge>& edges) {
  waiting_.insert(waiting_.end(), edges.begin(), edges.end());
  if (waiting_.size() >= edges_at_once) hand_over();
  return goes_on_;
}

void EdgeBatches::finish() { hand_over(); }

void EdgeBatches::hand_over() {
  if (!waiting_.empty() && goes_on_) goes_on_ = take_(waiting_);
  waiting_.clear();
}

void find_hidden_edges(const program::Program& label, const CellTree& tree, int threads, const StopFlag* stop,
                       const TakeEdges& take) {
  EdgeBatches batches(take);
  hidden_edges_in(all_layers(tree.lattice()), label, tree, threads, stop,
                  [&](const std::vector<CrossedEdge>& edges) { return batches.add(edges); });
  batches.finish();
}

}  // namespace ombre::surface
