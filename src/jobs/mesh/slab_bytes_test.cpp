#include "jobs/mesh/slab_bytes.h"

#include <gtest/gtest.h>

#include "base/text/error.h"

namespace ombre::jobs {

TEST(SlabBytes, AreReadAsTheyWereWritten) {
  surface::GridBorders borders;
  borders.cells = {{{1, 2, 3}, {0, 1, 1, 0, 2, 0, 0, 1}}, {{2, 2, 3}, {1, 1, 1, 0, 2, 0, 0, 1}}};
  borders.crossings = {{{0.25, -1, 1e-9}, {0, 0.6, 0.8}}};
  surface::CrossedEdge edge;
  edge.start = {8, 16, -24};
  edge.axis = 2;
  edge.level = 3;
  edge.from = 1;
  edge.leaves.fill(surface::CellTree::none);
  borders.hidden = {{}, {edge, edge}};

  const std::string bytes = slab_bytes(borders);
  const surface::GridBorders read = read_slab(bytes);
  ASSERT_EQ(read.cells.size(), 2U);
  EXPECT_EQ(read.cells[1].at, borders.cells[1].at);
  EXPECT_EQ(read.cells[1].corners, borders.cells[1].corners);
  ASSERT_EQ(read.crossings.size(), 1U);
  EXPECT_EQ(read.crossings[0].at, borders.crossings[0].at);
  EXPECT_EQ(read.crossings[0].normal, borders.crossings[0].normal);
  ASSERT_EQ(read.hidden.size(), 2U);
  EXPECT_TRUE(read.hidden[0].empty());
  ASSERT_EQ(read.hidden[1].size(), 2U);
  EXPECT_EQ(read.hidden[1][1].start, edge.start);
  EXPECT_EQ(read.hidden[1][1].axis, 2);
  EXPECT_EQ(read.hidden[1][1].level, 3);
  EXPECT_EQ(read.hidden[1][1].from, 1);
  EXPECT_EQ(read.hidden[1][1].to, 0);
  EXPECT_EQ(read.hidden[1][1].leaves, edge.leaves);
  EXPECT_EQ(slab_bytes(read), bytes);
}

TEST(SlabBytes, ThatEndTooEarlyAreRefused) {
  const std::string bytes = slab_bytes({{}, {{{1, 2, 3}, {0, 0, 1}}}, {{}}});
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(read_slab(std::string_view(bytes).substr(0, size)), Error) << size;
}

}  // namespace ombre::jobs
