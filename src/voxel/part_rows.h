// Many parts over the voxels of a tile, each evaluated only where its boxes reach.
#pragma once

#include <vector>

#include "eval/batch/batch.h"
#include "program/parts.h"
#include "voxel/layer_points.h"
#include "voxel/leaf.h"
#include "voxel/row_kernels.h"

namespace ombre::voxel {

// Rows of the slots that a program reads of its part sets.
class PartRows {
 public:
  PartRows(const VoxelJob& job, const eval::KernelSet& kernels)
      : job_(job), kernels_(row_kernels(kernels.name)), batch_(kernels) {}

  // Parts that are asked anywhere but at (x, y, z) itself are not for this.
  static bool suits(const program::Program& program);

  void begin(const program::Program& program, const TileBox& tile);
  // Along row (j, k) of the tile.
  const float* row(uint32_t set, size_t slot, size_t j, size_t k) const;

 private:
  struct SlotRows {
    uint32_t set = 0;  // the program's first of this part set
    size_t slot = 0;
    std::vector<float> values;  // [k][j][i], padded rows
  };

  void add_part(const program::PartSet& set, uint32_t part, const TileBox& box);
  void descend(const program::PartSet& set, const TileBox& box);
  void evaluate(const program::PartSet& set, const TileBox& box);
  void merge_row(const program::PartSet& set, const TileBox& box, int64_t j, int64_t k);
  TileBox voxels_in(const Box& box) const;
  float* at(SlotRows& rows, int64_t i, int64_t j, int64_t k) const;

  const VoxelJob& job_;
  RowKernels kernels_;
  eval::BatchEvaluator batch_;
  TileBox tile_;
  size_t stride_ = 0;
  std::vector<uint32_t> first_set_;  // of each of the program's part sets
  std::vector<SlotRows> slots_;
  std::vector<SlotRows*> wanted_;  // of the set at work
  std::vector<program::PartIndex::Entry> found_;
  program::Program body_;
  std::vector<program::ValueId> body_slots_;
  std::vector<size_t> body_output_;  // of each wanted slot
  std::vector<Interval> ranges_;
  LayerPoints points_;
};

}  // namespace ombre::voxel
