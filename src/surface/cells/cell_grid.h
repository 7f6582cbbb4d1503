// A grid of cells over the corners of a lattice, and its mixed cells: those whose corners lie in more than one region.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/system/progress.h"
#include "surface/cells/partition.h"
#include "voxel/lattice.h"

namespace ombre::surface {

// Corner (i, j, k) lies at lattice.center(i, j, k); cell (i, j, k) has corners i, i + 1 and so on.
// A corner's number within its cell is x + 2 y + 4 z of its offsets. Edge 4 a + u + 2 v runs along axis a, with offset
// u along axis a + 1 and offset v along axis a + 2 (axes modulo 3).
using CellPlace = std::array<int32_t, 3>;

constexpr int edge_number(int axis, int u, int v) { return 4 * axis + u + 2 * v; }
constexpr int axis_of_edge(int edge) { return edge / 4; }
// Returns the offsets of an edge's first corner.
constexpr std::array<int, 3> start_of_edge(int edge) {
  std::array<int, 3> start{};
  const auto axis = static_cast<size_t>(edge / 4);
  start[(axis + 1) % 3] = edge & 1;
  start[(axis + 2) % 3] = edge >> 1 & 1;
  return start;
}
constexpr size_t corner_number(const std::array<int, 3>& offsets) {
  size_t number = 0;
  for (size_t axis = 0; axis < 3; ++axis) number += static_cast<size_t>(offsets[axis]) << axis;
  return number;
}
constexpr size_t first_corner(int edge) { return corner_number(start_of_edge(edge)); }
constexpr size_t second_corner(int edge) { return first_corner(edge) + (size_t{1} << axis_of_edge(edge)); }

struct MixedCell {
  CellPlace at{};
  std::array<Label, 8> corners{};
  bool crosses(int edge) const { return corners[first_corner(edge)] != corners[second_corner(edge)]; }
};

// The mixed cells, ordered by z, then y, then x.
class MixedCells {
 public:
  static constexpr uint32_t none = ~uint32_t{0};

  MixedCells(const voxel::Lattice& corners, std::vector<MixedCell> cells);
  const voxel::Lattice& lattice() const { return lattice_; }
  const std::vector<MixedCell>& cells() const { return cells_; }
  // Returns the number of the mixed cell at a place, or none if the cell there is not mixed.
  uint32_t find(const CellPlace& at) const;

 private:
  voxel::Lattice lattice_;
  std::vector<MixedCell> cells_;
  // index of the first cell of each row (j, k); the last entry is the number of cells
  std::vector<uint32_t> row_begins_;
};

// Layers [begin, end) of cells along z.
struct CellLayers {
  int64_t begin = 0, end = 0;
};
inline CellLayers all_layers(const voxel::Lattice& corners) { return {0, corners.count[2] - 1}; }

// Returns the mixed cells of some layers, in order. Evaluates the labels of their corners tile by tile in single
// precision. The outermost corners of the lattice count as void. Throws Cancelled.
std::vector<MixedCell> mixed_cells_in(CellLayers layers, const program::Program& label, const voxel::Lattice& corners,
                                      int threads, Progress* progress = nullptr, const StopFlag* stop = nullptr);

// Returns the mixed cells of all layers. Throws Cancelled.
MixedCells find_mixed_cells(const program::Program& label, const voxel::Lattice& corners, int threads,
                            Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::surface
