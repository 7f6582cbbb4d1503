// Evaluates many parts over the voxels of a tile, each only where its boxes reach.
#pragma once

#include <vector>

#include "eval/batch/batch.h"
#include "program/parts.h"
#include "voxel/leaf.h"
#include "voxel/row_kernels.h"
#include "voxel/tile_points.h"

namespace ombre::voxel {

// The compiled program of one kind of parts. Each part's constants are inserted before evaluation.
class PartBody {
 public:
  PartBody(const program::PartSet& set, uint32_t body, const std::vector<size_t>& slots,
           const eval::KernelSet& kernels);
  void take(const program::PartTable& table, uint32_t part);

  const program::Program& program() const { return program_; }
  eval::BatchEvaluator& batch() { return batch_; }
  eval::Values reached() const { return batch_.output(0); }
  eval::Values held() const { return batch_.output(1); }
  // True if parts of this kind have slots[n].
  bool has(size_t n) const { return output_[n] != none; }
  eval::Values output(size_t n) const { return batch_.output(output_[n]); }

 private:
  static constexpr size_t none = ~size_t{0};

  program::Program program_;
  std::vector<program::ValueId> constants_;
  std::vector<size_t> output_;
  eval::BatchEvaluator batch_;
};

// Rows of values of the slots that a program reads. Voxels are grouped into blocks of batch_lanes along x, most of
// which no part touches.
class PartRows {
 public:
  PartRows(const VoxelJob& job, const eval::KernelSet& kernels);

  // True if the program evaluates parts only at (x, y, z) itself.
  static bool suits(const program::Program& program);

  void begin(const program::Program& program, const TileBox& tile, const TilePoints& points);
  // Sets blocks that no part touched to 0. They are undefined before.
  void touch_all();
  // Returns a bit mask; bit b is set if a part touched voxels [16 b, 16 (b + 1)) of the tile's row.
  uint64_t touched(int64_t j, int64_t k) const { return touched_[row_number(j, k)]; }
  // Returns the values from voxel i on. The tile's width is padded.
  const float* row(uint32_t set, size_t slot, RowPlace at, int64_t k) const {
    const Set& read = *by_number_[set];
    return values_.data() + offset(read.first_plane + read.numbers[slot], at.i, at.j, k);
  }

 private:
  struct KeptBody {
    uint32_t number = 0;
    std::unique_ptr<PartBody> body;
  };
  // A part set, and the slots that the job's program reads.
  struct Set {
    const program::PartSet* parts = nullptr;
    std::vector<size_t> slots;
    std::vector<size_t> numbers;  // position of each slot in `slots`
    std::vector<KeptBody> bodies;
    size_t first_plane = 0;
  };

  void place_sets(const program::Program& program);
  void add_part(Set& set, uint32_t part, const TileBox& box);
  void descend(const Set& set, PartBody& body, const TileBox& box, bool ask);
  void evaluate(const Set& set, PartBody& body, const TileBox& box);
  void merge_row(const Set& set, const PartBody& body, size_t lane, RowPlace at, int64_t k, size_t width);
  void touch(size_t row, uint64_t blocks);
  TileBox voxels_in(const Box& box) const;
  size_t row_number(int64_t j, int64_t k) const {
    return static_cast<size_t>((k - tile_.lo[2]) * tile_.size(1) + (j - tile_.lo[1]));
  }
  size_t plane_floats() const { return stride_ * touched_.size(); }
  size_t offset(size_t plane, int64_t i, int64_t j, int64_t k) const {
    return plane * plane_floats() + row_number(j, k) * stride_ + static_cast<size_t>(i - tile_.lo[0]);
  }

  const VoxelJob& job_;
  const eval::KernelSet& batch_kernels_;
  RowKernels kernels_;
  std::vector<Set> sets_;
  std::vector<Set*> by_number_, read_;  // the sets of the current program, by number and each once
  TileBox tile_;
  const TilePoints* points_ = nullptr;
  size_t stride_ = 0, plane_count_ = 0;
  std::vector<uint64_t> touched_;  // [k][j]
  std::vector<float> values_;      // [plane][k][j][i]
  std::vector<program::PartIndex::Entry> found_;
  std::vector<eval::PointRow> rows_;
  std::vector<Interval> ranges_;
};

}  // namespace ombre::voxel
