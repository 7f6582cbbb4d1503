#include "surface/mesh/vertex_place.h"

#include <gtest/gtest.h>

#include <numbers>

#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

// A tree of one cell from (2, 2, 2) to (3, 3, 3).
CellTree single_cell() {
  return CellTree(MixedCells(corners_from_origin({6, 6, 6}), {MixedCell{{2, 2, 2}, {1, 0, 0, 0, 0, 0, 0, 0}}}));
}

constexpr Vec3 middle_of_cell{2.5, 2.5, 2.5};

// Returns the vertex of three planes that meet in a corner. Each passes through a point beside the way from the middle
// of the cell to the corner, and the middle is the mean of these points.
DualVertex with_planes_to(Vec3 corner) {
  const Vec3 way = corner - middle_of_cell, any = std::abs(way.x) < length(way) / 2 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 side = cross(way, any), u = (1 / length(side)) * side, v = (1 / length(way)) * cross(way, u);
  DualVertex vertex;
  for (int n = 0; n < 3; ++n) {
    const double angle = 2 * std::numbers::pi * n / 3;
    const Vec3 beside = std::cos(angle) * u + std::sin(angle) * v, point = middle_of_cell + 0.4 * beside;
    const Vec3 normal = cross(corner - point, cross(way, beside));
    vertex.planes.add(point, (1 / length(normal)) * normal);
  }
  return vertex;
}

}  // namespace

TEST(VertexPlace, RoomIsHalfACellWider) {
  const CellTree tree = single_cell();
  EXPECT_EQ(room_of(tree, {2, 2, 2}, grid_level), (Box{{1.5, 1.5, 1.5}, {3.5, 3.5, 3.5}}));
  // A cell of half the size has half the room; one of twice the size has that of the grid's cells.
  EXPECT_EQ(room_of(tree, {4, 4, 5}, grid_level - 1), (Box{{1.75, 1.75, 2.25}, {2.75, 2.75, 3.25}}));
  EXPECT_EQ(room_of(tree, {1, 1, 1}, grid_level + 1), (Box{{1.5, 1.5, 1.5}, {4.5, 4.5, 4.5}}));
}

TEST(VertexPlace, IsWherePlanesMeet) {
  const CellTree tree = single_cell();
  for (const Vec3 corner : {Vec3{2.25, 2.75, 2.5}, Vec3{1.75, 2.5, 3.25}, Vec3{3.4, 1.6, 2.1}})
    EXPECT_LT(length(place_of(with_planes_to(corner), tree) - corner), 1e-9);
}

TEST(VertexPlace, StaysInTheRoomOnTheWayToThere) {
  const CellTree tree = single_cell();
  const Box room = room_of(tree, {2, 2, 2}, grid_level).expanded(1e-12);
  for (const Vec3 corner : {Vec3{2.5, 2.5, 4.5}, Vec3{4.2, 1.4, 3}, Vec3{0.9, 0.9, 0.9}}) {
    const DualVertex vertex = with_planes_to(corner);
    const Vec3 place = place_of(vertex, tree), mean = middle_of_cell;
    EXPECT_TRUE(room.contains(place));
    EXPECT_FALSE(room.expanded(-1e-9).contains(place)) << "it goes as far as it can";
    EXPECT_LT(length(cross(place - mean, corner - mean)), 1e-9);
    EXPECT_GT(dot(place - mean, corner - mean), 0);
  }
}

}  // namespace ombre::surface
