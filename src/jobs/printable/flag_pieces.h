// Connected pieces of regions of voxels, found layer by layer (two-pass labelling of runs; Rosenfeld and Pfaltz, 1966).
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/math/index_box.h"
#include "jobs/printable/bit_layer.h"

namespace ombre::compile {

// Voxels that are connected by their faces.
struct FlagPiece {
  uint64_t voxels = 0;
  IndexBox box;

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

  // If `counts` is given, it says which pieces are found.
  explicit FlagPieceFinder(Counts counts = nullptr) : counts_(std::move(counts)) {}

  // Takes the next layer, which has the number k.
  void add(int64_t k, const BitLayer& layer);
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
  void close_finished(Rows& rows);
  void close(const FlagPiece& piece);

  Counts counts_;
  Rows last_;
  std::vector<uint32_t> parents_;
  std::vector<FlagPiece> pieces_;  // of the labels that are roots
  FlagPieces done_;
};

}  // namespace ombre::compile
