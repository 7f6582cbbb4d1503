// Evaluates outputs of a program as numbers on a voxel lattice, tile by tile.
#include "voxel/fields.h"

#include <cmath>
#include <optional>

#include "base/text/error.h"
#include "eval/batch/batch.h"
#include "eval/rows.h"
#include "program/evaluate.h"
#include "program/passes/narrow.h"
#include "program/passes/prepare.h"
#include "voxel/place_sources.h"
#include "voxel/tile_points.h"

namespace ombre::voxel {

struct FieldEvaluator::Parts {
  program::Program reference, batch;
  Lattice lattice;
  RowSamplers samplers;
  Evaluator evaluator = Evaluator::batch;
};

namespace {

constexpr int64_t field_strip_rows = 64;
// Size of tiles that are evaluated without being divided further.
constexpr int64_t leaf_width = 32, leaf_height = 8;

// Removes the sign of zero, which depends on whether a tile was evaluated by intervals or by voxels.
float plain(float value) { return value + 0.0f; }

// Gives values of sources along the rows of a tile.
class TileRows : public eval::SourceRows {
 public:
  TileRows(const StripSources& sources, const TileBox& tile) : sources_(sources), tile_(tile) {}
  bool has(const program::Read& read) const override { return sources_.has(read.tag); }
  void fill(const program::Read& read, const eval::RowsToFill& rows) const override {
    const int64_t k = tile_.lo[2] + static_cast<int64_t>(rows.layer);
    for (size_t n = 0; n < rows.count; ++n) {
      const int64_t j = tile_.lo[1] + static_cast<int64_t>(rows.first + n);
      sources_.fill(read.tag, tile_.lo[0], j, k, std::span<float>(rows.values + n * rows.stride, rows.width));
    }
  }

 private:
  const StripSources& sources_;
  const TileBox& tile_;
};

// Traverses the tiles of a strip on one thread.
class FieldTraversal {
 public:
  FieldTraversal(const FieldEvaluator::Parts& parts, std::vector<FieldTile>& tiles) : parts_(parts), tiles_(tiles) {
    if (is_batch()) batch_.emplace(eval::kernel_sets().front());
  }

  void run(const TileBox& strip) {
    sources_.emplace(parts_.samplers, strip);
    ask(is_batch() ? parts_.batch : parts_.reference, strip);
  }

 private:
  bool is_batch() const { return parts_.evaluator == Evaluator::batch; }
  program::Precision precision() const {
    return is_batch() ? program::Precision::batch : program::Precision::reference;
  }
  static bool is_small(const TileBox& tile) { return tile.size(0) <= leaf_width && tile.size(1) <= leaf_height; }

  void ask(const program::Program& program, const TileBox& tile) {
    std::vector<Interval> values, kept;
    evaluate_intervals(program, centers(parts_.lattice, tile), values, sources_->ranges(tile), precision());
    if (settle(program, values, tile)) return;
    const program::Program shorter = program::shorten(program, values, &kept);
    if (!is_small(tile)) return cut(shorter, tile);
    if (shorter.has_parts()) return ask(program::expand_parts(shorter, kept, precision()), tile);
    FieldTile& made = tiles_.emplace_back();
    made.box = tile;
    made.values.resize(program.outputs.size() * static_cast<size_t>(tile.voxels()));
    if (is_batch())
      compute(shorter, kept, made);
    else
      compute_by_reference(shorter, made, false);
  }

  bool settle(const program::Program& program, const std::vector<Interval>& values, const TileBox& tile) {
    for (const program::ValueId output : program.outputs)
      if (!values[output].is_point()) return false;
    FieldTile& settled = tiles_.emplace_back();
    settled.box = tile;
    settled.is_uniform = true;
    for (const program::ValueId output : program.outputs)
      settled.values.push_back(plain(static_cast<float>(values[output].lo)));
    return true;
  }

  // Halves a tile along its longer side, measured in leaf tiles. Leaf tiles begin at multiples of their size.
  void cut(const program::Program& program, const TileBox& tile) {
    const size_t axis = tile.size(0) * leaf_height > tile.size(1) * leaf_width ? 0 : 1;
    const int64_t unit = axis == 0 ? leaf_width : leaf_height;
    const int64_t first = multiple_below(tile.lo[axis], unit), last = multiple_below(tile.hi[axis] - 1, unit);
    const int64_t units = (last - first) / unit + 1;
    TileBox low = tile, high = tile;
    low.hi[axis] = high.lo[axis] = first + std::max<int64_t>(units / 2, 1) * unit;
    ask(program, low);
    ask(program, high);
  }

  void compute(const program::Program& program, const std::vector<Interval>& ranges, FieldTile& made) {
    const TileBox& tile = made.box;
    const TileRows rows(*sources_, tile);
    const auto width = eval::padded(static_cast<size_t>(tile.size(0)));
    points_.place(parts_.lattice, tile);
    point_rows_.clear();
    for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j) point_rows_.push_back(points_.row({tile.lo[0], j}));
    batch_->compile(program, ranges, width * point_rows_.size(), static_cast<size_t>(tile.size(2)), rows);
    batch_->place({point_rows_, points_.layers(tile.lo[2], tile.hi[2]), width});
    bool has_unknown = false;
    for (int64_t k = 0; k < tile.size(2); ++k) {
      batch_->begin_layer(static_cast<size_t>(k));
      batch_->begin_row(0);
      batch_->finish_row();
      has_unknown |= take_layer(k, width, made);
    }
    if (has_unknown) redo_unknown(made);
  }

  // Copies a layer of values. Returns true if one of them is NaN.
  bool take_layer(int64_t k, size_t width, FieldTile& made) {
    const TileBox& tile = made.box;
    bool has_unknown = false;
    const auto voxels = static_cast<size_t>(tile.voxels()), layer = static_cast<size_t>(tile.size(0) * tile.size(1));
    for (size_t n = 0; n * voxels < made.values.size(); ++n) {
      const eval::Values values = batch_->output(n);
      float* to = made.values.data() + n * voxels + static_cast<size_t>(k) * layer;
      for (size_t j = 0; j < point_rows_.size(); ++j)
        for (int64_t i = 0; i < tile.size(0); ++i, ++to) {
          *to = plain(values[j * width + static_cast<size_t>(i)]);
          has_unknown |= std::isnan(*to);
        }
    }
    return has_unknown;
  }

  void redo_unknown(FieldTile& made) {
    const program::Program left = program::narrow_to_parts(parts_.reference, centers(parts_.lattice, made.box),
                                                           program::Precision::reference, sources_->ranges(made.box));
    compute_by_reference(left, made, true);
  }

  void compute_by_reference(const program::Program& program, FieldTile& made, bool only_unknown) {
    const TileBox& tile = made.box;
    xs_.clear();
    for (int64_t i = tile.lo[0]; i < tile.hi[0]; ++i) xs_.push_back(parts_.lattice.center(i, 0, 0).x);
    size_t offset = 0;
    for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k)
      for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j, offset += xs_.size()) {
        run_row(program, tile, j, k);
        take_row(program, offset, only_unknown, made);
      }
  }

  void run_row(const program::Program& program, const TileBox& tile, int64_t j, int64_t k) {
    const Vec3 p = parts_.lattice.center(tile.lo[0], j, k);
    const eval::SourceRow source_row = [&](const program::Read& read, std::span<double> values) {
      if (!sources_->has(read.tag)) return false;
      sources_->fill(read.tag, tile.lo[0], j, k, values);
      return true;
    };
    rows_.set_row(xs_, p.y, p.z);
    rows_.run(program, 0, program.code.size(), source_row);
  }

  void take_row(const program::Program& program, size_t offset, bool only_unknown, FieldTile& made) const {
    for (size_t n = 0; n < program.outputs.size(); ++n) {
      const auto values = rows_.values(program.outputs[n]);
      float* to = made.values.data() + n * static_cast<size_t>(made.box.voxels()) + offset;
      for (size_t i = 0; i < values.size(); ++i)
        if (!only_unknown || std::isnan(to[i])) to[i] = plain(static_cast<float>(values[i]));
    }
  }

  const FieldEvaluator::Parts& parts_;
  std::vector<FieldTile>& tiles_;
  std::optional<StripSources> sources_;  // sources along the current strip
  std::optional<eval::BatchEvaluator> batch_;
  eval::RowEvaluator rows_{static_cast<size_t>(leaf_width)};
  TilePoints points_;
  std::vector<eval::PointRow> point_rows_;
  std::vector<double> xs_;
};

}  // namespace

FieldEvaluator::FieldEvaluator(program::Program program, const Lattice& lattice, Evaluator evaluator)
    : parts_(std::make_unique<Parts>(Parts{std::move(program), {}, lattice, {}, evaluator})) {
  parts_->samplers = place_sources(parts_->reference, design_from_index(lattice));
  if (evaluator == Evaluator::batch) parts_->batch = program::prepare(parts_->reference, program::Purpose::batch);
}

FieldEvaluator::~FieldEvaluator() = default;

std::vector<FieldTile> FieldEvaluator::tiles(const TileBox& region, const StopFlag* stop) const {
  std::vector<FieldTile> tiles;
  FieldTraversal traversal(*parts_, tiles);
  for (int64_t j = region.lo[1]; j < region.hi[1];) {
    if (stop && stop->requested()) throw Cancelled();
    const int64_t end = std::min(multiple_below(j, field_strip_rows) + field_strip_rows, region.hi[1]);
    traversal.run({{region.lo[0], j, region.lo[2]}, {region.hi[0], end, region.hi[2]}});
    j = end;
  }
  return tiles;
}

}  // namespace ombre::voxel
