#include "surface/cells/hidden_edges.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

using Edges = std::vector<CrossedEdge>;

Edges hidden_in(const Partition& partition, const voxel::Lattice& corners, int threads) {
  const CellTree tree(find_mixed_cells(partition.label, corners, 1));
  Edges all;
  find_hidden_edges(partition.label, tree, threads, nullptr, [&](const Edges& edges) {
    all.insert(all.end(), edges.begin(), edges.end());
    return true;
  });
  return all;
}

constexpr Vec3 pocket{4.5, 5.45, 3.5};  // the middle of a small ball between corners

// A ball around a corner and one between corners.
Partition two_balls() {
  return solid_where_negative([](program::Builder& b) {
    const auto far = [&](Vec3 from) { return length(b.input(0) - from.x, b.input(1) - from.y, b.input(2) - from.z); };
    return min(far({12, 5, 5}) - 2.3, far(pocket) - 0.4);
  });
}

}  // namespace

TEST(HiddenEdges, AreThoseThatNoCornerShows) {
  const voxel::Lattice corners = corners_from_origin({17, 11, 11});
  const Edges edges = hidden_in(two_balls(), corners, 1);
  const CellTree tree(find_mixed_cells(two_balls().label, corners, 1));
  ASSERT_FALSE(edges.empty());
  for (const CrossedEdge& edge : edges) {
    const Vec3 first = tree.point(edge.start);
    Vec3 last = first;
    last[edge.axis] += tree.size_mm(edge.level)[edge.axis];
    EXPECT_EQ(last[edge.axis] - first[edge.axis], 0.25);
    EXPECT_EQ(edge.from == 1, length(first - pocket) < 0.4);
    EXPECT_EQ(edge.to == 1, length(last - pocket) < 0.4);
    EXPECT_NE(edge.from, edge.to);
  }
}

TEST(HiddenEdges, AreTheSameForAnyNumberOfThreads) {
  const voxel::Lattice corners = corners_from_origin({17, 11, 11});
  const Edges one = hidden_in(two_balls(), corners, 1), three = hidden_in(two_balls(), corners, 3);
  ASSERT_EQ(one.size(), three.size());
  for (size_t n = 0; n < one.size(); ++n) {
    EXPECT_EQ(one[n].start, three[n].start);
    EXPECT_EQ(one[n].axis, three[n].axis);
  }
}

TEST(HiddenEdges, AreNoneWhereCornersShowAll) {
  EXPECT_TRUE(hidden_in(ball_of({8, 5, 5}, 3.2), corners_from_origin({17, 11, 11}), 1).empty());
}

// A quarter of the cells' pitch is no Pitch.
TEST(HiddenEdges, AreNotSoughtInTheSmallestCells) {
  voxel::Lattice corners = corners_from_origin({5, 5, 5});
  int64_t most = 1;
  while (Pitch::from_ratio(1, 4 * most)) most *= 4;
  for (Pitch& pitch : corners.pitch) pitch = {1, most};
  EXPECT_TRUE(hidden_in(ball_of({0, 0, 0}, 1), corners, 1).empty());
}

TEST(HiddenEdges, AreSoughtUntilTheSearchIsStopped) {
  const CellTree tree(find_mixed_cells(two_balls().label, corners_from_origin({17, 11, 11}), 1));
  StopFlag stop;
  stop.request();
  EXPECT_THROW(find_hidden_edges(two_balls().label, tree, 1, &stop, [](const Edges&) { return true; }), Cancelled);
}

}  // namespace ombre::surface
