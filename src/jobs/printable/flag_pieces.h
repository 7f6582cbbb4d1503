// Connected pieces of regions of voxels, found layer by layer (two-pass labelling of runs; Rosenfeld and Pfaltz, 1966).
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/math/index_box.h"
#include "jobs/printable/bit_layer.h"

namespace ombre::compile {

// Voxels [begin, end) of a row of a layer.
struct FlagRun {
  int64_t k = 0, j = 0, begin = 0, end = 0;
  bool operator==(const FlagRun&) const = default;
};

// Voxels that are connected by their faces.
struct FlagPiece {
  uint64_t voxels = 0;
  IndexBox box;
  bool is_pinned = false;          // some of its voxels are pins
  std::vector<FlagRun> runs = {};  // its voxels, if the finder keeps them

  bool operator==(const FlagPiece&) const = default;
};

struct FlagPieces {
  uint64_t count = 0, voxels = 0;
  std::vector<FlagPiece> largest;  // at most FlagPieceFinder::most, the largest first
};

// Keeps memory for two layers and the pieces that reach them.
class FlagPieceFinder {
 public:
  static constexpr size_t most = 10;
  using Counts = std::function<bool(const FlagPiece& piece)>;

  // If `counts` is given, it says which pieces are found. It is given the runs of pieces that have at most so many
  // voxels.
  explicit FlagPieceFinder(Counts counts = nullptr, uint64_t kept_voxels = 0)
      : counts_(std::move(counts)), kept_voxels_(kept_voxels) {}

  // Takes the next layer, which has the number k. Pieces with voxels of `pins`, if it is given, are pinned.
  void add(int64_t k, const BitLayer& layer, const BitLayer* pins = nullptr);
  // Returns the voxels of the last layer whose pieces, as far as they are known by then, have the property.
  BitLayer last_where(const Counts& holds);
  // Returns the pieces of all layers.
  FlagPieces finish();

 private:
  struct Run {
    int64_t begin = 0, end = 0;
    uint32_t label = 0;
  };
  using Rows = std::vector<std::vector<Run>>;

  uint32_t root(uint32_t label);
  void join(const std::vector<Run>& before, Run& run);
  void merge(uint32_t a, uint32_t b);
  void keep(FlagPiece& piece, const FlagRun& run) const;
  void close_finished(Rows& rows);
  void close(const FlagPiece& piece);

  Counts counts_;
  uint64_t kept_voxels_ = 0;
  Rows last_;
  int64_t width_ = 0;
  std::vector<uint32_t> parents_;
  std::vector<FlagPiece> pieces_;  // of the labels that are roots
  FlagPieces done_;
};

}  // namespace ombre::compile
