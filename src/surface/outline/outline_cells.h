// One layer of square cells: where borders of regions cross their edges, and which crossings belong together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/vec.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

// Labels of a layer's corners, x fastest. The outermost corners are void.
struct CornerLabels {
  int32_t width = 0, height = 0;
  std::vector<Label> labels;
  Label at(int32_t i, int32_t j) const { return labels[static_cast<size_t>(j) * static_cast<size_t>(width) + i]; }
};

// The crossing of the edge from corner (i, j) one step along an axis. From vertex ends[0] to ends[1] through the
// crossing, region `from` is on the left.
struct OutlineCrossing {
  int32_t i = 0, j = 0;
  uint8_t axis = 0;
  Label from = 0, to = 0;  // regions at the ends of the edge
  std::array<uint32_t, 2> ends{};
  Vec2 at;      // mm
  Vec2 normal;  // unit vector from region `from` into region `to`
};

// The vertex of one part of cell (i, j), with the crossings that it connects: two where two regions meet, else three or
// four.
struct OutlineVertex {
  int32_t i = 0, j = 0;
  uint8_t count = 0;
  std::array<uint32_t, 4> crossings{};
  Vec2 at;  // mm
  bool is_junction() const { return count != 2; }
};

struct OutlineGraph {
  std::vector<OutlineCrossing> crossings;
  std::vector<OutlineVertex> vertices;
};

// Returns the crossings and vertices of a layer, without positions. In cells where both diagonals could be joined, the
// greater label is joined.
OutlineGraph trace_cells(const CornerLabels& corners);

}  // namespace ombre::surface
