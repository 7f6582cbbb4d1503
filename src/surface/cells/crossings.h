// Points where edges of cells cross the borders of regions, with the normals of the borders there.
#pragma once

#include <vector>

#include "base/system/progress.h"
#include "surface/cells/crossed_edges.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

struct Crossing {
  static constexpr uint32_t none = ~uint32_t{0};
  CrossedEdge edge;
  Vec3 at;                 // mm
  Vec3 normal;             // unit vector from the edge's region `from` into region `to`
  uint32_t before = none;  // its number before the last growth, if the edge was already crossed
};

// Where an edge crosses a border, in mm, and the normal as of a Crossing.
struct BorderPoint {
  Vec3 at, normal;
};

// Returns all crossings, in order of their leaves, then axes. Throws Cancelled.
std::vector<Crossing> find_crossings(const Partition& partition, const CellTree& tree, int threads,
                                     Progress* progress = nullptr, const StopFlag* stop = nullptr);

// Returns the crossings of a tree in which no leaf is subdivided, whose points were found before. Throws Error if those
// are not as many as the tree has, and Cancelled.
std::vector<Crossing> crossings_at(const std::vector<BorderPoint>& points, const CellTree& tree, int threads,
                                   const StopFlag* stop = nullptr);

// Returns all crossings after the tree grew, and copies those that are known from `before`. `leaves` maps old numbers
// of leaves to new ones. Throws Cancelled.
std::vector<Crossing> find_crossings_after_growth(const Partition& partition, const CellTree& tree,
                                                  const std::vector<Crossing>& before,
                                                  const std::vector<uint32_t>& leaves, int threads,
                                                  const StopFlag* stop = nullptr);

}  // namespace ombre::surface
