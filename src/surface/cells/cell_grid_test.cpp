#include "surface/cells/cell_grid.h"

#include <gtest/gtest.h>

#include <set>

#include "base/text/error.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr Vec3 ball_middle{6.2, 5.9, 10.4};
constexpr double ball_radius = 4.3;

// Returns the label of a corner, where the outermost ones are void.
Label label_in_ball(const voxel::Lattice& corners, const CellPlace& at) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (at[axis] == 0 || at[axis] == corners.count[axis] - 1) return 0;
  return length(corners.center(at[0], at[1], at[2]) - ball_middle) < ball_radius ? 1 : 0;
}

MixedCell cell_at(const voxel::Lattice& corners, const CellPlace& at) {
  MixedCell cell{at, {}};
  for (int n = 0; n < 8; ++n)
    cell.corners[static_cast<size_t>(n)] =
        label_in_ball(corners, {at[0] + (n & 1), at[1] + (n >> 1 & 1), at[2] + (n >> 2 & 1)});
  return cell;
}

}  // namespace

TEST(CellGrid, EdgesJoinNeighbouringCorners) {
  std::set<std::pair<size_t, size_t>> edges;
  for (int edge = 0; edge < 12; ++edge) {
    const size_t difference = second_corner(edge) - first_corner(edge);
    EXPECT_EQ(difference, size_t{1} << axis_of_edge(edge));
    EXPECT_EQ(first_corner(edge) & difference, 0U);
    EXPECT_LT(second_corner(edge), 8U);
    edges.emplace(first_corner(edge), second_corner(edge));
  }
  EXPECT_EQ(edges.size(), 12U);
}

TEST(CellGrid, MixedCellsAreThoseWithDifferentCorners) {
  // The ball sticks out of the grid above and below, where the outermost corners cut it off.
  const voxel::Lattice corners = corners_from_origin({14, 12, 14});
  const Partition ball = ball_of(ball_middle, ball_radius);
  for (const int threads : {1, 3}) {
    const MixedCells found = find_mixed_cells(ball.label, corners, threads);
    size_t next = 0;
    for (int32_t k = 0; k < 13; ++k)
      for (int32_t j = 0; j < 11; ++j)
        for (int32_t i = 0; i < 13; ++i) {
          const MixedCell cell = cell_at(corners, {i, j, k});
          const bool is_mixed = std::set<Label>(cell.corners.begin(), cell.corners.end()).size() > 1;
          EXPECT_EQ(found.find({i, j, k}), is_mixed ? static_cast<uint32_t>(next) : MixedCells::none);
          if (!is_mixed) continue;
          ASSERT_LT(next, found.cells().size());
          EXPECT_EQ(found.cells()[next].at, cell.at);
          EXPECT_EQ(found.cells()[next].corners, cell.corners);
          ++next;
        }
    EXPECT_EQ(next, found.cells().size());
    EXPECT_EQ(found.find({-1, 3, 3}), MixedCells::none);
    EXPECT_EQ(found.find({3, 12, 3}), MixedCells::none);
    EXPECT_EQ(found.find({3, 3, 1000}), MixedCells::none);
  }
}

// The outermost of 5 x 5 x 5 cells touch a void corner.
TEST(CellGrid, SpaceEndsAtTheOutermostCorners) {
  const Partition full = solid_where_negative([](program::Builder& b) { return b.constant(-1); });
  EXPECT_EQ(find_mixed_cells(full.label, corners_from_origin({6, 6, 6}), 1).cells().size(), 125U - 27U);
  const Partition empty = solid_where_negative([](program::Builder& b) { return b.constant(1); });
  EXPECT_TRUE(find_mixed_cells(empty.label, corners_from_origin({6, 6, 6}), 1).cells().empty());
}

TEST(CellGrid, SearchesStopOnRequest) {
  StopFlag stop;
  stop.request();
  const Partition ball = ball_of(ball_middle, ball_radius);
  EXPECT_THROW(find_mixed_cells(ball.label, corners_from_origin({14, 12, 14}), 2, nullptr, &stop), Cancelled);
}

}  // namespace ombre::surface
