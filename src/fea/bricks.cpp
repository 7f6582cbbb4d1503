#include "fea/bricks.h"

#include <algorithm>

namespace ombre::fea {
namespace {

template <class List>
size_t find(const List& list, const Cell& cell) {
  const auto place = std::ranges::lower_bound(list, cell, is_before);
  return place != list.end() && *place == cell ? static_cast<size_t>(place - list.begin()) : list.size();
}

Cell corner_of(const Cell& cell, const Cell& offset) {
  return {cell[0] + offset[0], cell[1] + offset[1], cell[2] + offset[2]};
}

}  // namespace

Bricks make_bricks(Vec3 origin, Vec3 size_mm, std::vector<Cell> cells) {
  Bricks bricks{origin, size_mm, std::move(cells), {}, {}};
  bricks.corners.reserve(bricks.cells.size() * 2);
  // Layer by layer, so that no more than two layers' corners are there several times.
  std::vector<Cell> found;
  const auto take = [&](int32_t below) {
    std::ranges::sort(found, is_before);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    const auto rest = std::ranges::find_if(found, [&](const Cell& corner) { return corner[2] >= below; });
    bricks.corners.insert(bricks.corners.end(), found.begin(), rest);
    found.erase(found.begin(), rest);
  };
  for (size_t n = 0; n < bricks.cells.size(); ++n) {
    if (n > 0 && bricks.cells[n][2] != bricks.cells[n - 1][2]) take(bricks.cells[n][2]);
    for (const Cell& offset : brick_corners) found.push_back(corner_of(bricks.cells[n], offset));
  }
  take(std::numeric_limits<int32_t>::max());
  bricks.nodes.resize(bricks.cells.size());
  for (size_t n = 0; n < bricks.cells.size(); ++n)
    for (size_t c = 0; c < 8; ++c)
      bricks.nodes[n][c] = static_cast<uint32_t>(find(bricks.corners, corner_of(bricks.cells[n], brick_corners[c])));
  return bricks;
}

std::vector<OuterFace> outer_faces(const Bricks& bricks) {
  std::vector<OuterFace> faces;
  for (size_t n = 0; n < bricks.count(); ++n)
    for (uint8_t axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        Cell beside = bricks.cells[n];
        beside[axis] += is_upper ? 1 : -1;
        if (find(bricks.cells, beside) == bricks.count()) faces.push_back({static_cast<uint32_t>(n), axis, is_upper});
      }
  return faces;
}

}  // namespace ombre::fea
