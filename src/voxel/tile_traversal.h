// Traverses the tiles of a strip: intervals settle what they can, a leaf evaluator does the rest.
#pragma once

#include <array>

#include "voxel/leaf.h"

namespace ombre::voxel {

// How tiles are cut and whether intervals are evaluated. This changes no voxel, only the speed.
struct TraversalOptions {
  bool prune = true;
  // Tiles that are evaluated without further questions; long programs pay for smaller ones, in which
  // more of them falls away.
  int64_t leaf_width = 64, leaf_height = 8;
  int64_t small_leaf_width = 16, small_leaf_height = 4;
  size_t long_program = 60;      // instructions for each voxel
  size_t many_parts = 4;         // while so many reach a tile, it is cut before they are written out
  bool write_parts_out = false;  // also those that the leaf could evaluate by itself
  // Wider tiles are always cut.
  int64_t widest = 256, highest = 16;
};

// One thread's traversal. It counts where interval evaluation pays, and does less of it where it does not.
class TileTraversal {
 public:
  TileTraversal(const VoxelJob& job, program::Precision precision, const TraversalOptions& options, LeafEvaluator& leaf)
      : job_(job), precision_(precision), options_(options), leaf_(leaf) {}

  // `program` is the selector's, or what is left of it where the strip lies.
  void run(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& strip,
           const StripSources& sources, StripVoxels& voxels);

 private:
  // How much work questions about tiles of about 2^level voxels have spared of late: 0 ... 1.
  struct Gain {
    double share = 1;
    uint32_t skipped = 0;
  };

  void descend(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile);
  void ask(const program::Program& program, const TileBox& tile);
  void cut(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile);
  bool is_long_program(const program::Program& program) const {
    return program.has_parts() || voxel_ops(program) >= options_.long_program;
  }
  static size_t voxel_ops(const program::Program& program);
  bool is_small(const program::Program& program, const TileBox& tile) const;
  bool must_cut(const TileBox& tile) const { return tile.size(0) > options_.widest || tile.size(1) > options_.highest; }
  bool pays(const program::Program& program, const TileBox& tile);

  const VoxelJob& job_;
  program::Precision precision_;
  TraversalOptions options_;
  LeafEvaluator& leaf_;
  const StripSources* sources_ = nullptr;
  StripVoxels* voxels_ = nullptr;
  std::array<Gain, 64> gains_;
};

}  // namespace ombre::voxel
