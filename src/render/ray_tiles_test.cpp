// Pieces fill a tile without gaps, the near ones first.
#include "render/ray_tiles.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace ombre::render {

TEST(RayTiles, PiecesFillTheTileOnce) {
  std::mt19937 random(1);
  for (int round = 0; round < 500; ++round) {
    TileBox tile;
    for (size_t axis = 0; axis < 3; ++axis) {
      tile.lo[axis] = static_cast<int64_t>(random() % 100) - 50;
      tile.hi[axis] = tile.lo[axis] + 1 + static_cast<int64_t>(random() % (axis == 0 ? 600 : 40));
    }
    const TileSize unit{16, 8, 4};
    const std::vector<TileBox> pieces = cut(tile, unit);
    EXPECT_LE(pieces.size(), 64U);
    int64_t samples = 0, nearest = tile.lo[0];
    std::set<std::array<int64_t, 3>> corners;
    for (const TileBox& piece : pieces) {
      EXPECT_TRUE(corners.insert(piece.lo).second);
      EXPECT_GE(piece.lo[0], nearest);
      nearest = piece.lo[0];
      samples += piece.voxels();
      for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ((piece.lo[axis] - tile.lo[axis]) % unit[axis], 0);
        EXPECT_LT(piece.lo[axis], piece.hi[axis]);
        EXPECT_LE(piece.hi[axis], tile.hi[axis]);
      }
    }
    EXPECT_EQ(samples, tile.voxels());
  }
}

// Repeated cutting ends at the units.
TEST(RayTiles, PiecesOfPiecesAreUnits) {
  TileBox tile{{0, 0, 0}, {6400, 32, 32}};
  const TileSize unit{32, 16, 8};
  int levels = 0;
  while (tile.size(0) > unit[0] || tile.size(1) > unit[1] || tile.size(2) > unit[2]) {
    tile = cut(tile, unit)[0];
    ASSERT_LT(++levels, 5);
  }
  EXPECT_EQ(tile.size(0), unit[0]);
  EXPECT_EQ(tile.size(1), unit[1]);
  EXPECT_EQ(tile.size(2), unit[2]);
}

}  // namespace ombre::render
