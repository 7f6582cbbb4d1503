// Where edges of cells cross the borders of regions, and how the borders lie there.
#pragma once

#include <vector>

#include "base/progress.h"
#include "surface/crossed_edges.h"
#include "surface/partition.h"

namespace ombre::surface {

struct Crossing {
  CrossedEdge edge;
  Vec3 at;      // mm
  Vec3 normal;  // unit; from the edge's region `from` into region `to`
};

// All crossings, in order of their leaves, then axes; what is known of edges that were asked before is taken over.
// Throws Cancelled.
std::vector<Crossing> find_crossings(const Partition& partition, const CellTree& tree,
                                     const std::vector<Crossing>& before, int threads, Progress* progress = nullptr,
                                     const StopFlag* stop = nullptr);

}  // namespace ombre::surface
