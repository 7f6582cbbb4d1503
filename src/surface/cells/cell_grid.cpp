#include "surface/cells/cell_grid.h"

#include <algorithm>

#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "voxel/fields.h"
#include "voxel/layers.h"

namespace ombre::surface {
namespace {

using voxel::FieldTile;
using voxel::Lattice;
using voxel::TileBox;

constexpr int64_t slab_layers = 8;  // number of layers of cells per slab

// Labels of the corners in a few layers.
class CornerSlab {
 public:
  explicit CornerSlab(const TileBox& box) : box_(box), labels_(static_cast<size_t>(box.voxels())) {}

  void take(const FieldTile& tile) {
    const float* from = tile.values.data();
    const int64_t width = tile.box.size(0);
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j) {
        Label* to = row(j, k) + tile.box.lo[0];
        for (int64_t i = 0; i < width; ++i) to[i] = static_cast<Label>(from[tile.is_uniform ? 0 : i]);
        if (!tile.is_uniform) from += width;
      }
  }

  void clear_outermost(const Lattice& lattice) {
    const int64_t nx = lattice.count[0], ny = lattice.count[1], nz = lattice.count[2];
    for (int64_t k = box_.lo[2]; k < box_.hi[2]; ++k)
      for (int64_t j = 0; j < ny; ++j) {
        Label* r = row(j, k);
        if (j == 0 || j == ny - 1 || k == 0 || k == nz - 1) std::fill_n(r, nx, Label{0});
        r[0] = r[nx - 1] = 0;
      }
  }

  void find_mixed(std::vector<MixedCell>& cells) {
    const int64_t nx = box_.size(0);
    std::vector<Label> differs(static_cast<size_t>(nx));
    for (int64_t k = box_.lo[2]; k + 1 < box_.hi[2]; ++k)
      for (int64_t j = 0; j + 1 < box_.size(1); ++j) {
        const Label* rows[] = {row(j, k), row(j + 1, k), row(j, k + 1), row(j + 1, k + 1)};
        mark(rows, nx - 1, differs.data());
        for (int64_t i = 0; i + 1 < nx; ++i)
          if (differs[static_cast<size_t>(i)]) cells.push_back(cell(rows, i, j, k));
      }
  }

 private:
  static void mark(const Label* const* rows, int64_t count, Label* differs) {
    const Label *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    for (int64_t i = 0; i < count; ++i)
      differs[i] = static_cast<Label>((a[i] ^ a[i + 1]) | (a[i] ^ b[i]) | (a[i] ^ b[i + 1]) | (a[i] ^ c[i]) |
                                      (a[i] ^ c[i + 1]) | (a[i] ^ d[i]) | (a[i] ^ d[i + 1]));
  }

  static MixedCell cell(const Label* const* rows, int64_t i, int64_t j, int64_t k) {
    MixedCell made{{static_cast<int32_t>(i), static_cast<int32_t>(j), static_cast<int32_t>(k)}, {}};
    for (size_t n = 0; n < 8; ++n) made.corners[n] = rows[n / 2][i + static_cast<int64_t>(n % 2)];
    return made;
  }

  Label* row(int64_t j, int64_t k) { return labels_.data() + ((k - box_.lo[2]) * box_.size(1) + j) * box_.size(0); }

  TileBox box_;
  std::vector<Label> labels_;
};

}  // namespace

MixedCells::MixedCells(const Lattice& corners, std::vector<MixedCell> cells)
    : lattice_(corners), cells_(std::move(cells)) {
  const auto rows = static_cast<size_t>(corners.count[1] * corners.count[2]);
  row_begins_.assign(rows + 1, 0);
  for (const MixedCell& cell : cells_)
    ++row_begins_[static_cast<size_t>(cell.at[2] * corners.count[1] + cell.at[1]) + 1];
  for (size_t n = 1; n <= rows; ++n) row_begins_[n] += row_begins_[n - 1];
}

uint32_t MixedCells::find(const CellPlace& at) const {
  for (size_t axis = 0; axis < 3; ++axis)
    if (at[axis] < 0 || at[axis] >= lattice_.count[axis]) return none;
  const auto row = static_cast<size_t>(at[2] * lattice_.count[1] + at[1]);
  const auto begin = cells_.begin() + row_begins_[row], end = cells_.begin() + row_begins_[row + 1];
  const auto found =
      std::lower_bound(begin, end, at[0], [](const MixedCell& cell, int32_t i) { return cell.at[0] < i; });
  return found != end && found->at[0] == at[0] ? static_cast<uint32_t>(found - cells_.begin()) : none;
}

std::vector<MixedCell> mixed_cells_in(CellLayers layers, const program::Program& label, const Lattice& corners,
                                      int threads, Progress* progress, const StopFlag* stop) {
  const voxel::FieldEvaluator evaluator(label, corners, voxel::best_evaluator(corners));
  const auto slabs = static_cast<size_t>((layers.end - layers.begin + slab_layers - 1) / slab_layers);
  const Stopwatch watch;
  std::vector<MixedCell> all;
  run_ordered<std::vector<MixedCell>>(
      slabs, threads, 2 * static_cast<size_t>(threads > 0 ? threads : core_count()),
      [&](size_t n) {
        const int64_t k = layers.begin + static_cast<int64_t>(n) * slab_layers;
        const TileBox box{{0, 0, k}, {corners.count[0], corners.count[1], std::min(k + slab_layers, layers.end) + 1}};
        CornerSlab slab(box);
        for (const FieldTile& tile : evaluator.tiles(box, stop)) slab.take(tile);
        slab.clear_outermost(corners);
        std::vector<MixedCell> cells;
        slab.find_mixed(cells);
        return cells;
      },
      [&](size_t n, std::vector<MixedCell>& cells) {
        if (stop && stop->requested()) throw Cancelled();
        all.insert(all.end(), cells.begin(), cells.end());
        if (progress) progress->update(at_steady_pace(n + 1, slabs, watch.seconds()));
      });
  return all;
}

MixedCells find_mixed_cells(const program::Program& label, const Lattice& corners, int threads, Progress* progress,
                            const StopFlag* stop) {
  return {corners, mixed_cells_in(all_layers(corners), label, corners, threads, progress, stop)};
}

}  // namespace ombre::surface
