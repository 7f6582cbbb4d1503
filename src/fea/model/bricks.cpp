#include "fea/model/bricks.h"

#include <algorithm>

#include "base/text/error.h"

namespace ombre::fea {
namespace {

size_t find_in(const std::vector<Cell>& list, const Cell& cell) {
  const auto place = std::ranges::lower_bound(list, cell, is_before);
  return place != list.end() && *place == cell ? static_cast<size_t>(place - list.begin()) : list.size();
}

Cell corner_of(const Cell& cell, const Cell& offset, const Cell& period) {
  Cell corner;
  for (size_t axis = 0; axis < 3; ++axis) {
    corner[axis] = cell[axis] + offset[axis];
    if (corner[axis] == period[axis]) corner[axis] = 0;
  }
  return corner;
}

constexpr size_t bricks_between_checks = 16384;

void check_stop(const StopFlag* stop) {
  if (stop && stop->requested()) throw Cancelled();
}

}  // namespace

size_t Bricks::find(const Cell& cell) const { return find_in(cells, cell); }

Bricks make_bricks(Vec3 origin, Vec3 size_mm, std::vector<Cell> cells, const Cell& period, const StopFlag* stop) {
  Bricks bricks{origin, size_mm, std::move(cells), {}, {}, period, {}};
  bricks.corners.reserve(bricks.cells.size() * 2);
  // Corners are gathered layer by layer, so that only corners of two layers are ever there several times. If the mesh
  // repeats along z, those of the first layer come again at the end.
  std::vector<Cell> found;
  const auto take = [&](int32_t below) {
    check_stop(stop);
    std::ranges::sort(found, is_before);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    const auto rest = std::ranges::find_if(found, [&](const Cell& corner) { return corner[2] >= below; });
    bricks.corners.insert(bricks.corners.end(), found.begin(), rest);
    found.erase(found.begin(), rest);
  };
  for (size_t n = 0; n < bricks.cells.size(); ++n) {
    if (n > 0 && bricks.cells[n][2] != bricks.cells[n - 1][2]) take(bricks.cells[n][2]);
    for (const Cell& offset : brick_corners) found.push_back(corner_of(bricks.cells[n], offset, period));
  }
  take(std::numeric_limits<int32_t>::max());
  if (period[2] > 0) {
    const auto again = std::is_sorted_until(bricks.corners.begin(), bricks.corners.end(), is_before);
    std::inplace_merge(bricks.corners.begin(), again, bricks.corners.end(), is_before);
    bricks.corners.erase(std::unique(bricks.corners.begin(), bricks.corners.end()), bricks.corners.end());
  }
  bricks.nodes.resize(bricks.cells.size());
  for (size_t n = 0; n < bricks.cells.size(); ++n) {
    if (n % bricks_between_checks == 0) check_stop(stop);
    for (size_t c = 0; c < 8; ++c)
      bricks.nodes[n][c] =
          static_cast<uint32_t>(find_in(bricks.corners, corner_of(bricks.cells[n], brick_corners[c], period)));
  }
  return bricks;
}

std::vector<OuterFace> outer_faces(const Bricks& bricks) {
  std::vector<OuterFace> faces;
  for (size_t n = 0; n < bricks.count(); ++n)
    for (uint8_t axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        Cell beside = bricks.cells[n];
        beside[axis] += is_upper ? 1 : -1;
        if (bricks.find(beside) == bricks.count()) faces.push_back({static_cast<uint32_t>(n), axis, is_upper});
      }
  return faces;
}

}  // namespace ombre::fea
