// Evaluates tiles with float batches.
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "eval/batch/batch.h"
#include "program/evaluate.h"
#include "program/passes/narrow.h"
#include "voxel/draws.h"
#include "voxel/layer_part_rows.h"
#include "voxel/leaf.h"
#include "voxel/row_kernels.h"
#include "voxel/tile_points.h"

namespace ombre::voxel {
namespace {

// Gives values of sources and parts along the rows that are being evaluated.
class RowsAtWork : public eval::SourceRows {
 public:
  explicit RowsAtWork(const PartRows& parts) : parts_(parts) {}
  bool has(const program::Read& read) const override { return sources->has(read.tag); }
  void fill(const program::Read& read, const eval::RowsToFill& rows) const override {
    for (size_t n = 0; n < rows.count; ++n) {
      const RowPlace at = places[rows.first + n];
      const std::span<float> values(rows.values + n * rows.stride, rows.width);
      sources->fill(read.tag, at.i, at.j, layer + static_cast<int64_t>(rows.layer), values);
    }
  }
  void fill_parts(uint32_t set, size_t slot, const eval::RowsToFill& rows) const override {
    for (size_t n = 0; n < rows.count; ++n) {
      const float* from = parts_.row(set, slot, places[rows.first + n], layer + static_cast<int64_t>(rows.layer));
      float* const to = rows.values + n * rows.stride;
      for (size_t i = 0; i < rows.width; i += eval::batch_lanes)
        std::memcpy(to + i, from + i, eval::batch_lanes * sizeof *to);
    }
  }

  const StripSources* sources = nullptr;
  std::vector<RowPlace> places;  // first voxels of the rows
  int64_t layer = 0;             // number of the layer that evaluation counts as layer 0

 private:
  const PartRows& parts_;
};

// Replaces parts by 0, the value where no part reaches.
program::Program without_parts(program::Program program) {
  for (program::Instruction& in : program.code)
    if (in.op == program::Op::parts) in = program::Instruction{};
  return program;
}

class BatchLeaf : public LeafEvaluator {
 public:
  BatchLeaf(const VoxelJob& job, const eval::KernelSet& kernels)
      : job_(job),
        kernels_(row_kernels(kernels.name)),
        batch_(kernels, eval::BatchEvaluator::Finish::inside),
        parts_(job, kernels),
        rows_(parts_),
        reference_(reference_leaf(job)) {}

  bool takes_parts(const program::Program& program) const override { return PartRows::suits(program); }

  void evaluate(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile,
                const StripSources& sources, StripVoxels& voxels) override {
    tile_ = tile;
    rows_.sources = &sources;
    rows_.layer = tile.lo[2];
    voxels_ = &voxels;
    find_used(program, ranges);
    has_reference_ = false;
    points_.place(job_.lattice, tile);
    if (program.has_parts()) {
      parts_.begin(program, tile, points_);
      if (is_empty_without_parts(program)) return evaluate_touched(program, ranges);
      parts_.touch_all();
    }
    place_rows();
    if (tile.size(0) <= narrow)
      evaluate_layers(program, ranges);
    else
      evaluate_rows(program, ranges);
  }

 private:
  // Consecutive voxels of a row, and the position of the first one in the evaluated rows.
  struct Stretch {
    RowPlace at;
    int64_t k = 0;
    size_t width = 0, lane = 0;
  };

  static constexpr size_t block = eval::batch_lanes;
  // Tiles up to this width are evaluated one layer at a time.
  static constexpr int64_t narrow = 64;
  static constexpr size_t most_blocks = 64;  // greatest number of blocks that are evaluated at once

  bool is_empty_without_parts(const program::Program& program) const {
    std::vector<Interval> values;
    evaluate_intervals(without_parts(program), centers(job_.lattice, tile_), values, rows_.sources->ranges(tile_),
                       program::Precision::batch);
    return values[program.outputs[0]] == Interval(0);
  }

  // Evaluates only blocks of voxels that some part touches.
  void evaluate_touched(const program::Program& program, const std::vector<Interval>& ranges) {
    batch_.compile(program, ranges, most_blocks * block, 1, rows_);
    for (int64_t k = tile_.lo[2]; k < tile_.hi[2]; ++k) {
      rows_.places.clear();
      for (int64_t j = tile_.lo[1]; j < tile_.hi[1]; ++j)
        for (uint64_t left = parts_.touched(j, k); left != 0; left &= left - 1) {
          rows_.places.push_back({tile_.lo[0] + static_cast<int64_t>(std::countr_zero(left) * block), j});
          if (rows_.places.size() == most_blocks) evaluate_blocks(k);
        }
      if (!rows_.places.empty()) evaluate_blocks(k);
    }
  }

  void evaluate_blocks(int64_t k) {
    rows_.layer = k;
    place_points(block, k, k + 1);
    evaluate_layer(k, block);
    rows_.places.clear();
  }

  void place_rows() {
    rows_.places.clear();
    for (int64_t j = tile_.lo[1]; j < tile_.hi[1]; ++j) rows_.places.push_back({tile_.lo[0], j});
  }

  void place_points(size_t width, int64_t begin, int64_t end) {
    point_rows_.clear();
    for (const RowPlace at : rows_.places) point_rows_.push_back(points_.row(at));
    batch_.place({point_rows_, points_.layers(begin, end), width});
  }

  void evaluate_layers(const program::Program& program, const std::vector<Interval>& ranges) {
    const size_t width = eval::padded(tile_width());
    batch_.compile(program, ranges, width * rows_.places.size(), static_cast<size_t>(tile_.size(2)), rows_);
    place_points(width, tile_.lo[2], tile_.hi[2]);
    for (int64_t k = tile_.lo[2]; k < tile_.hi[2]; ++k) evaluate_layer(k, width);
  }

  // Evaluates a layer of the current rows, each of which is `width` wide, a multiple of a block.
  void evaluate_layer(int64_t k, size_t width) {
    const std::vector<RowPlace>& places = rows_.places;
    batch_.begin_layer(static_cast<size_t>(k - rows_.layer));
    batch_.begin_row(0);
    if (!kernels_.any(batch_.output(0), width * places.size())) return;
    finish_row();
    for (size_t first = 0, end = 0; first < places.size(); first = end) {
      const RowPlace at = places[first];
      const auto follows = [&](size_t n) {
        return places[n].j == at.j && places[n].i == at.i + static_cast<int64_t>((n - first) * width);
      };
      for (end = first + 1; end < places.size() && follows(end);) ++end;
      const size_t most = static_cast<size_t>(tile_.hi[0] - at.i);
      stretch_ = {at, k, std::min((end - first) * width, most), first * width};
      if (kernels_.any(output(0), stretch_.width)) take();
    }
  }

  void evaluate_rows(const program::Program& program, const std::vector<Interval>& ranges) {
    batch_.begin(program, ranges, points_.all(), rows_);
    for (int64_t k = tile_.lo[2]; k < tile_.hi[2]; ++k) {
      batch_.begin_layer(static_cast<size_t>(k - tile_.lo[2]));
      for (size_t row = 0; row < rows_.places.size(); ++row) {
        batch_.begin_row(row);
        if (!kernels_.any(batch_.output(0), tile_width())) continue;
        finish_row();
        stretch_ = {rows_.places[row], k, tile_width(), 0};
        take();
      }
    }
  }

  void finish_row() {
    batch_.finish_row_inside();
    for (const size_t n : used_) outputs_[n] = batch_.output(n);
  }

  // Finds the outputs that matter in the tile.
  void find_used(const program::Program& program, const std::vector<Interval>& ranges) {
    used_.assign(1, 0);
    unknown_outputs_.clear();
    checks_.clear();
    outputs_.resize(program.outputs.size());
    find_choices(program);
    used_.insert(used_.end(), choices_.begin(), choices_.end());
    for (size_t c = 0, n = 1 + job_.selector.threshold_count; c < job_.selector.check_count; ++c, ++n) {
      if (constant(program, n) == 0.0) continue;
      checks_.push_back(c);
      used_.push_back(n);
    }
    for (const size_t n : used_)
      if (ranges[program.outputs[n]].is_everything()) unknown_outputs_.push_back(n);
  }

  // Finds the materials that draws can select in this tile. These lie between the last threshold that is 0 and the
  // first that is 1. Of materials with equal thresholds only the last counts.
  void find_choices(const program::Program& program) {
    const Selector& selector = job_.selector;
    choices_.clear();
    materials_.assign(1, selector.materials[0]);
    for (size_t t = 0; t < selector.threshold_count; ++t) {
      const auto value = constant(program, 1 + t);
      if (value == 1.0) return;
      const bool is_new = choices_.empty() || program.outputs[choices_.back()] != program.outputs[1 + t];
      if (value == 0.0) {
        choices_.clear();
        materials_.assign(1, selector.materials[t + 1]);
      } else if (is_new) {
        choices_.push_back(1 + t);
        materials_.push_back(selector.materials[t + 1]);
      } else {
        materials_.back() = selector.materials[t + 1];
      }
    }
  }

  static std::optional<double> constant(const program::Program& program, size_t output) {
    const program::Instruction& in = program.code[program.outputs[output]];
    return in.op == program::Op::constant ? std::optional(in.value) : std::nullopt;
  }

  size_t tile_width() const { return static_cast<size_t>(tile_.size(0)); }
  // Returns an output along the current stretch.
  eval::Values output(size_t n) const { return outputs_[n].from(stretch_.lane); }

  void take() {
    const auto& [at, k, width, lane] = stretch_;
    thresholds_.clear();
    for (const size_t n : choices_) thresholds_.push_back(output(n));
    // Constructed in place: copying a struct just after its members were written would stall.
    const ChoiceRow row{output(0), thresholds_, materials_, draws(), at.i, width};
    kernels_.choose(row, voxels_->at(at.i, at.j, k));
    for (size_t t = 0; t < voxels_->kept_thresholds(); ++t) keep_threshold(t);
    for (const size_t c : checks_) count_check(c, row.inside);
    if (has_unknown(row.inside)) redo_unknown(row.inside);
  }

  Draws draws() const { return choices_.empty() ? Draws{} : draws_of_row(job_, stretch_.at.j, stretch_.k); }

  bool has_unknown(const eval::Values& inside) const {
    for (const size_t n : unknown_outputs_)
      if (kernels_.unknown(inside, output(n), stretch_.width)) return true;
    return false;
  }

  void keep_threshold(size_t t) {
    float* to = voxels_->threshold(t, stretch_.at.i, stretch_.at.j, stretch_.k);
    const eval::Values from = batch_.output(1 + t).from(stretch_.lane);
    if (from.is_number)
      std::fill_n(to, stretch_.width, *from.row);
    else
      std::copy_n(from.row, stretch_.width, to);
  }

  void count_check(size_t check, const eval::Values& inside) {
    const eval::Values flags = output(1 + job_.selector.threshold_count + check);
    if (!kernels_.any(flags, stretch_.width)) return;
    for (size_t n = 0; n < stretch_.width; ++n) {
      const bool counts = inside[n] != 0 && flags[n] != 0 && !is_unknown(n, inside);
      if (counts) voxels_->note_check(check, stretch_.at.i + static_cast<int64_t>(n), stretch_.at.j, stretch_.k);
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

  // Evaluates voxels whose values are NaN again, with the reference.
  void redo_unknown(const eval::Values& inside) {
    const auto& [at, k, width, lane] = stretch_;
    for (size_t n = 0; n < width;) {
      size_t end = n;
      while (end < width && is_unknown(end, inside)) ++end;
      if (end > n)
        redo({{at.i + static_cast<int64_t>(n), at.j, k}, {at.i + static_cast<int64_t>(end), at.j + 1, k + 1}});
      n = end + 1;
    }
  }

  void redo(const TileBox& stretch) {
    if (!has_reference_) {
      shorten_reference();
      has_reference_ = true;
    }
    std::fill_n(voxels_->at(stretch.lo[0], stretch.lo[1], stretch.lo[2]), stretch.size(0), MaterialId{0});
    reference_->evaluate(reference_program_, {}, stretch, *rows_.sources, *voxels_);
  }

  void shorten_reference() {
    reference_program_ = program::narrow_to_parts(job_.selector.reference, centers(job_.lattice, tile_),
                                                  program::Precision::reference, rows_.sources->ranges(tile_));
  }

  const VoxelJob& job_;
  RowKernels kernels_;
  eval::BatchEvaluator batch_;
  PartRows parts_;
  RowsAtWork rows_;
  std::unique_ptr<LeafEvaluator> reference_;
  TileBox tile_;
  TilePoints points_;
  std::vector<eval::PointRow> point_rows_;
  std::vector<eval::Values> outputs_;  // outputs along the current rows
  Stretch stretch_;
  StripVoxels* voxels_ = nullptr;
  // Numbers of outputs: all that matter, thresholds, and those that may be NaN.
  std::vector<size_t> used_, choices_, unknown_outputs_;
  std::vector<size_t> checks_;         // checks that may fail
  std::vector<MaterialId> materials_;  // one more than choices_
  bool has_reference_ = false;
  program::Program reference_program_;
  std::vector<eval::Values> thresholds_;
};

}  // namespace

std::unique_ptr<LeafEvaluator> batch_leaf(const VoxelJob& job, const eval::KernelSet& kernels) {
  return std::make_unique<BatchLeaf>(job, kernels);
}

}  // namespace ombre::voxel
