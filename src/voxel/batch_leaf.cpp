// Tiles in float batches.
#include <cmath>

#include "eval/batch/batch.h"
#include "program/passes/passes.h"
#include "voxel/draws.h"
#include "voxel/layer_points.h"
#include "voxel/leaf.h"
#include "voxel/part_rows.h"
#include "voxel/row_kernels.h"

namespace ombre::voxel {
namespace {

class TileRows : public eval::SourceRows {
 public:
  TileRows(const StripSources& sources, const TileBox& tile, const PartRows& parts)
      : sources_(sources), tile_(tile), parts_(parts) {}
  bool has(const program::Read& read) const override { return sources_.has(read.tag); }
  void fill(const program::Read& read, size_t j, size_t k, std::span<float> values) const override {
    sources_.fill(read.tag, tile_.lo[0], tile_.lo[1] + static_cast<int64_t>(j), tile_.lo[2] + static_cast<int64_t>(k),
                  values);
  }
  void fill_parts(uint32_t set, size_t slot, size_t j, size_t k, std::span<float> values) const override {
    std::copy_n(parts_.row(set, slot, j, k), values.size(), values.data());
  }

 private:
  const StripSources& sources_;
  const TileBox& tile_;
  const PartRows& parts_;
};

class BatchLeaf : public LeafEvaluator {
 public:
  BatchLeaf(const VoxelJob& job, const eval::KernelSet& kernels)
      : job_(job),
        kernels_(row_kernels(kernels.name)),
        batch_(kernels),
        parts_(job, kernels),
        reference_(reference_leaf(job)) {}

  bool takes_parts(const program::Program& program) const override { return PartRows::suits(program); }

  void evaluate(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile,
                const StripSources& sources, StripVoxels& voxels) override {
    tile_ = tile;
    sources_ = &sources;
    voxels_ = &voxels;
    unknown_outputs_.clear();
    for (size_t n = 0; n < program.outputs.size(); ++n)
      if (ranges[program.outputs[n]].is_everything()) unknown_outputs_.push_back(n);
    has_reference_ = false;
    if (program.has_parts()) parts_.begin(program, tile);
    const TileRows rows(sources, tile_, parts_);
    by_layers_ = tile.size(0) <= narrow;
    if (by_layers_)
      evaluate_layers(program, ranges, rows);
    else
      evaluate_rows(program, ranges, rows);
  }

 private:
  // Tiles up to this width are evaluated a layer at a time.
  static constexpr int64_t narrow = 64;

  void evaluate_layers(const program::Program& program, const std::vector<Interval>& ranges, const TileRows& rows) {
    points_.place(job_.lattice, tile_);
    points_.evaluate(batch_, kernels_, program, ranges, rows, [&](int64_t k) {
      for (row_ = 0; row_ < static_cast<size_t>(tile_.size(1)); ++row_)
        take_row(tile_.lo[1] + static_cast<int64_t>(row_), tile_.lo[2] + k);
    });
  }

  void evaluate_rows(const program::Program& program, const std::vector<Interval>& ranges, const TileRows& rows) {
    place(tile_);
    batch_.begin(program, ranges, eval::BoxPoints{xs_, ys_, zs_}, rows);
    for (int64_t k = tile_.lo[2]; k < tile_.hi[2]; ++k) {
      batch_.begin_layer(static_cast<size_t>(k - tile_.lo[2]));
      for (int64_t j = tile_.lo[1]; j < tile_.hi[1]; ++j) {
        batch_.begin_row(static_cast<size_t>(j - tile_.lo[1]));
        if (!kernels_.any(batch_.output(0), xs_.size())) continue;
        batch_.finish_row();
        take_row(j, k);
      }
    }
  }

  void place(const TileBox& tile) {
    const Lattice& lattice = job_.lattice;
    const auto centers = [&](size_t axis, std::vector<float>& values) {
      values.clear();
      for (int64_t n = tile.lo[axis]; n < tile.hi[axis]; ++n)
        values.push_back(static_cast<float>(lattice.center(n, n, n)[static_cast<int>(axis)]));
    };
    centers(0, xs_);
    centers(1, ys_);
    centers(2, zs_);
  }

  // An output along the row at work.
  eval::Values output(size_t n) const { return by_layers_ ? points_.row(batch_.output(n), row_) : batch_.output(n); }
  size_t width() const { return static_cast<size_t>(tile_.size(0)); }

  void take_row(int64_t j, int64_t k) {
    const eval::Values inside = output(0);
    if (by_layers_ && !kernels_.any(inside, width())) return;
    thresholds_.clear();
    for (size_t t = 0; t < job_.selector.threshold_count; ++t) thresholds_.push_back(output(1 + t));
    MaterialId* out = voxels_->at(tile_.lo[0], j, k);
    const Draws draws = draws_of_row(job_.dither, job_.seed, j, k);
    kernels_.choose(present({inside, thresholds_, job_.selector.materials, draws, tile_.lo[0], width()}), out);
    for (size_t t = 0; t < voxels_->kept_thresholds(); ++t) keep_threshold(t, j, k);
    for (size_t c = 0; c < job_.selector.check_count; ++c) count_check(c, inside, j, k);
    if (has_unknown(inside)) redo_unknown(inside, j, k);
  }

  // Only the materials that draws can fall to here: those between the last threshold 0 and the first 1.
  static ChoiceRow present(ChoiceRow row) {
    const auto is = [&](size_t t, float value) {
      return row.thresholds[t].is_number && *row.thresholds[t].row == value;
    };
    size_t end = 0, begin = 0;
    while (end < row.thresholds.size() && !is(end, 1)) ++end;
    for (size_t t = 0; t < end; ++t)
      if (is(t, 0)) begin = t + 1;
    row.thresholds = row.thresholds.subspan(begin, end - begin);
    row.materials = row.materials.subspan(begin, end - begin + 1);
    return row;
  }

  bool has_unknown(const eval::Values& inside) const {
    for (const size_t n : unknown_outputs_)
      if (kernels_.unknown(inside, output(n), width())) return true;
    return false;
  }

  void keep_threshold(size_t t, int64_t j, int64_t k) {
    float* to = voxels_->threshold(t, tile_.lo[0], j, k);
    const eval::Values& from = thresholds_[t];
    if (from.is_number)
      std::fill_n(to, width(), *from.row);
    else
      std::copy_n(from.row, width(), to);
  }

  void count_check(size_t check, const eval::Values& inside, int64_t j, int64_t k) {
    const eval::Values marks = output(1 + job_.selector.threshold_count + check);
    if (marks.is_number && *marks.row == 0) return;
    for (size_t n = 0; n < width(); ++n) {
      const bool counts = inside[n] != 0 && marks[n] != 0 && !is_unknown(n, inside);
      if (counts) voxels_->note_check(check, tile_.lo[0] + static_cast<int64_t>(n), j, k);
    }
  }

  bool is_unknown(size_t n, const eval::Values& inside) const {
    if (unknown_outputs_.empty()) return false;
    if (std::isnan(inside[n])) return true;
    if (inside[n] == 0) return false;
    for (const size_t o : unknown_outputs_)
      if (std::isnan(output(o)[n])) return true;
    return false;
  }

  // Stretches of voxels that ended as NaN.
  void redo_unknown(const eval::Values& inside, int64_t j, int64_t k) {
    for (size_t n = 0; n < width();) {
      size_t end = n;
      while (end < width() && is_unknown(end, inside)) ++end;
      if (end > n)
        redo({{tile_.lo[0] + static_cast<int64_t>(n), j, k}, {tile_.lo[0] + static_cast<int64_t>(end), j + 1, k + 1}});
      n = end + 1;
    }
  }

  void redo(const TileBox& stretch) {
    if (!has_reference_) {
      shorten_reference();
      has_reference_ = true;
    }
    std::fill_n(voxels_->at(stretch.lo[0], stretch.lo[1], stretch.lo[2]), stretch.size(0), MaterialId{0});
    reference_->evaluate(reference_program_, {}, stretch, *sources_, *voxels_);
  }

  void shorten_reference() {
    std::vector<Interval> ranges;
    evaluate_intervals(job_.selector.reference, centers(job_.lattice, tile_), ranges, sources_->ranges(tile_));
    std::vector<Interval> kept;
    reference_program_ = program::shorten(job_.selector.reference, ranges, &kept);
    if (reference_program_.has_parts())
      reference_program_ = program::expand_parts(reference_program_, kept, program::Precision::reference);
  }

  const VoxelJob& job_;
  RowKernels kernels_;
  eval::BatchEvaluator batch_;
  PartRows parts_;
  std::unique_ptr<LeafEvaluator> reference_;
  TileBox tile_;
  const StripSources* sources_ = nullptr;
  StripVoxels* voxels_ = nullptr;
  std::vector<size_t> unknown_outputs_;  // that may be NaN in the tile
  bool has_reference_ = false;
  program::Program reference_program_;
  bool by_layers_ = false;
  size_t row_ = 0;  // of the tile, while layers are taken row by row
  LayerPoints points_;
  std::vector<float> xs_, ys_, zs_;
  std::vector<eval::Values> thresholds_;
};

}  // namespace

std::unique_ptr<LeafEvaluator> batch_leaf(const VoxelJob& job, const eval::KernelSet& kernels) {
  return std::make_unique<BatchLeaf>(job, kernels);
}

}  // namespace ombre::voxel
