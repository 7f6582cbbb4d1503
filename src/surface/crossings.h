// Where edges of cells cross the borders of regions, and how the borders lie there.
#pragma once

#include <vector>

#include "surface/cell_grid.h"

namespace ombre::surface {

// Of the edge that begins at corner 0 of a cell and runs along an axis.
struct Crossing {
  uint32_t cell = 0;
  uint8_t axis = 0;
  Label from = 0, to = 0;  // regions at the edge's ends
  Vec3 at;                 // mm
  Vec3 normal;             // unit; from region `from` into region `to`
};

// All crossings, in order of their cells, then axes. Throws Cancelled.
std::vector<Crossing> find_crossings(const Partition& partition, const MixedCells& cells, int threads,
                                     Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::surface
