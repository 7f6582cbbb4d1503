#include "surface/mesh/vertex_place.h"

#include <algorithm>
#include <cmath>

namespace ombre::surface {
namespace {

// Margin around a cell in which its vertex may lie, in sides of the cell, or in sides of the grid's cells if the cell
// is larger than those.
constexpr double vertex_room_cells = 0.5;

// Returns the point as far from the mean, which lies in the cell, towards the best point as the cell extends.
Vec3 within(const Box& cell, Vec3 mean, Vec3 best) {
  double share = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = best[axis] - mean[axis];
    const double room = (way > 0 ? cell.hi : cell.lo)[axis] - mean[axis];
    if (std::abs(way) > std::abs(room)) share = std::min(share, way != 0 ? room / way : 1);
  }
  return mean + std::max(share, 0.0) * (best - mean);
}

}  // namespace

Box room_of(const CellTree& tree, const CellPlace& place, int level) {
  const auto corner = [&](int32_t more) {
    return tree.point({(place[0] + more) << level, (place[1] + more) << level, (place[2] + more) << level});
  };
  return Box{corner(0), corner(1)}.expanded(vertex_room_cells * tree.size_mm(std::min(level, grid_level)).x);
}

Vec3 place_of(const DualVertex& vertex, const CellTree& tree) {
  const Leaf& leaf = tree.leaves()[vertex.leaf];
  const CellPlace place{leaf.at[0] >> leaf.level, leaf.at[1] >> leaf.level, leaf.at[2] >> leaf.level};
  return within(room_of(tree, place, leaf.level), vertex.planes.mean(), vertex.planes.least().at);
}

}  // namespace ombre::surface
