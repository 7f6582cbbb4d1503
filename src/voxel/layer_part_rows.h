// Many parts over the voxels of a tile, each evaluated only where its boxes reach.
#pragma once

#include <vector>

#include "eval/batch/batch.h"
#include "program/parts.h"
#include "voxel/leaf.h"
#include "voxel/row_kernels.h"
#include "voxel/tile_points.h"

namespace ombre::voxel {

// Parts of one kind: their program, compiled once, into which each part's constants are put.
class PartBody {
 public:
  PartBody(const program::PartSet& set, uint32_t body, const std::vector<size_t>& slots,
           const eval::KernelSet& kernels);
  void take(const program::PartTable& table, uint32_t part);

  const program::Program& program() const { return program_; }
  eval::BatchEvaluator& batch() { return batch_; }
  eval::Values reached() const { return batch_.output(0); }
  eval::Values held() const { return batch_.output(1); }
  // Of slots[n], if parts of this kind have it.
  bool has(size_t n) const { return output_[n] != none; }
  eval::Values output(size_t n) const { return batch_.output(output_[n]); }

 private:
  static constexpr size_t none = ~size_t{0};

  program::Program program_;
  std::vector<program::ValueId> constants_;
  std::vector<size_t> output_;
  eval::BatchEvaluator batch_;
};

// Rows of the slots that a program reads of its part sets. Voxels go in blocks of batch_lanes along x; most
// of them no part touches.
class PartRows {
 public:
  PartRows(const VoxelJob& job, const eval::KernelSet& kernels);

  // Parts that are evaluated anywhere but at (x, y, z) itself are not for this.
  static bool suits(const program::Program& program);

  void begin(const program::Program& program, const TileBox& tile, const TilePoints& points);
  // Blocks that no part touched hold 0 only after touch_all.
  void touch_all();
  // Bit b: some part touched voxels [16 b, 16 (b + 1)) of the tile's row.
  uint64_t touched(int64_t j, int64_t k) const { return touched_[row_number(j, k)]; }
  // From voxel i on; the tile's width is padded.
  const float* row(uint32_t set, size_t slot, RowPlace at, int64_t k) const {
    const Set& read = *by_number_[set];
    return values_.data() + offset(read.first_plane + read.numbers[slot], at.i, at.j, k);
  }

 private:
  struct KeptBody {
    uint32_t number = 0;
    std::unique_ptr<PartBody> body;
  };
  // A part set and what the job's program reads of it.
  struct Set {
    const program::PartSet* parts = nullptr;
    std::vector<size_t> slots;
    std::vector<size_t> numbers;  // of the slots among `slots`
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
  std::vector<Set*> by_number_, read_;  // of the program at work; each once
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
