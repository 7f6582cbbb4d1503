// Tests of the parts of borders within one cell.
#include "surface/cells/cell_parts.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace ombre::surface {
namespace {

std::array<Label, 8> corners_of(unsigned bits) {
  std::array<Label, 8> corners{};
  for (size_t n = 0; n < 8; ++n) corners[n] = bits >> n & 1;
  return corners;
}

size_t edges_in(const CellParts& parts, uint8_t part) {
  size_t count = 0;
  for (const uint8_t p : parts.part_of_edge) count += p == part;
  return count;
}

}  // namespace

TEST(CellParts, OneCornerIsATriangle) {
  for (size_t corner = 0; corner < 8; ++corner) {
    const CellParts parts = find_cell_parts(corners_of(1U << corner));
    EXPECT_EQ(parts.count, 1);
    EXPECT_EQ(edges_in(parts, 0), 3u);
  }
}

TEST(CellParts, UniformCellsHaveNone) {
  EXPECT_EQ(find_cell_parts(corners_of(0)).count, 0);
  EXPECT_EQ(find_cell_parts(corners_of(255)).count, 0);
}

TEST(CellParts, OppositeCornersAreApart) { EXPECT_EQ(find_cell_parts(corners_of(1 | 128)).count, 2); }

// The greater label is joined across the diagonal of a face.
TEST(CellParts, DiagonalsJoinTheGreaterLabel) {
  EXPECT_EQ(find_cell_parts(corners_of(1 | 8)).count, 1);
  EXPECT_EQ(find_cell_parts(corners_of(255 & ~9U)).count, 2);
}

// Every part between two regions is a ring of at least three edges, and every crossed edge belongs to one part.
TEST(CellParts, OfTwoRegionsAreRings) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    const auto corners = corners_of(bits);
    const CellParts parts = find_cell_parts(corners);
    ASSERT_LE(parts.count, 4);
    for (uint8_t part = 0; part < parts.count; ++part) EXPECT_GE(edges_in(parts, part), 3u) << bits;
    for (int e = 0; e < 12; ++e) {
      const bool is_crossed = corners[first_corner(e)] != corners[second_corner(e)];
      EXPECT_EQ(parts.part_of_edge[static_cast<size_t>(e)] != CellParts::none, is_crossed) << bits;
    }
  }
}

// Three regions around a line through the middle of the cell share one part.
TEST(CellParts, WhereThreeRegionsMeetThereIsOne) {
  const CellParts parts = find_cell_parts({1, 2, 3, 3, 1, 2, 3, 3});
  EXPECT_EQ(parts.count, 1);
}

}  // namespace ombre::surface
