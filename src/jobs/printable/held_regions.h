// Regions of void that hold what is poured into them from above.
#pragma once

#include "jobs/printable/flag_pieces.h"

namespace ombre::compile {

// A voxel of void is held if no path of void leads from it to the outside through its own layer and those below it.
// Pieces of held voxels are cups if they open into a layer above; otherwise they are closed hollows, which are not
// found.
class HeldRegionFinder {
 public:
  // Says whether the void outside the part does not reach the piece: that void begins below layer 0.
  static bool is_enclosed(const FlagPiece& piece) { return piece.box.lo[2] >= 0; }

  // Takes the void of the next layer, from -1 on. Returns the held voxels of the layer before it that open into it.
  BitLayer add(int64_t k, const BitLayer& open);
  // Returns the cups of all layers; the highest layer is all void.
  FlagPieces finish() { return cups_.finish(); }

 private:
  FlagPieceFinder regions_;
  FlagPieceFinder cups_{[](const FlagPiece& piece) { return piece.is_pinned; }};
  BitLayer held_;  // of the last layer
};

}  // namespace ombre::compile
