// Traverses the tiles of a strip. Tiles whose voxels intervals determine are filled at once; a leaf evaluator computes
// the others.
#pragma once

#include <array>

#include "voxel/leaf.h"

namespace ombre::voxel {

// Options for dividing tiles and for evaluating intervals. They affect only speed, no voxel.
struct TraversalOptions {
  bool prune = true;
  // Tiles of this size are not divided further. Long programs have smaller ones, in which pruning leaves less of the
  // program.
  int64_t leaf_width = 64, leaf_height = 8;
  int64_t small_leaf_width = 16, small_leaf_height = 4;
  size_t long_program = 60;      // number of ops per voxel that makes a program long
  size_t many_parts = 4;         // a tile that this many parts reach is divided before they are replaced by their code
  bool write_parts_out = false;  // also replaces parts that the leaf could evaluate itself
  // Tiles that are wider or higher than this are always divided.
  int64_t widest = 256, highest = 16;
};

// Traverses tiles on one thread. It measures where evaluating intervals pays, and evaluates fewer where it does not.
class TileTraversal {
 public:
  TileTraversal(const VoxelJob& job, program::Precision precision, const TraversalOptions& options, LeafEvaluator& leaf)
      : job_(job), precision_(precision), options_(options), leaf_(leaf) {}

  // `program` is the selector's, or its specialisation to a region that contains the strip.
  void run(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& strip,
           const StripSources& sources, StripVoxels& voxels);

 private:
  // Recent share (0 to 1) of the work that evaluating intervals saved, for tiles of about 2^level voxels.
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
