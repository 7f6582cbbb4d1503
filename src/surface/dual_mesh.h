// The dual mesh at full resolution: a vertex for each part of a cell, a quad around each crossed edge.
#pragma once

#include <array>
#include <vector>

#include "surface/crossings.h"
#include "surface/quadric.h"

namespace ombre::surface {

struct DualVertex {
  uint32_t cell = 0;
  bool parts_two = false;  // exactly two regions meet there
  Quadric planes;
};

// Around the edge of a crossing, counter-clockwise as seen from region `front`. Corner n lies in the cell where the
// edge has offsets quad_offsets[n].
struct DualQuad {
  uint32_t crossing = 0;
  std::array<uint32_t, 4> corners{};
};
constexpr std::array<std::array<int, 2>, 4> quad_offsets{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

struct DualMesh {
  std::vector<DualVertex> vertices;
  std::vector<DualQuad> quads;
};

DualMesh make_dual_mesh(const MixedCells& cells, const std::vector<Crossing>& crossings);

}  // namespace ombre::surface
