// Finds the borders in a grid of cells before any is subdivided: which cells are mixed, where their edges cross
// borders, and which edges inside of unmixed cells do.
#pragma once

#include <vector>

#include "surface/cells/crossings.h"
#include "surface/cells/hidden_edges.h"
#include "surface/cells/workers.h"

namespace ombre::surface {

struct GridBorders {
  std::vector<MixedCell> cells;
  std::vector<BorderPoint> crossings;            // of the edges that the cells list, in their order
  std::vector<std::vector<CrossedEdge>> hidden;  // of each strip; their leaves are not set

  // Appends what was found in the layers above.
  void append(GridBorders&& above);
};

// Finds the borders of some layers, as hidden_edges_in() takes them. What is found does not depend on the other layers,
// so the borders of a whole grid may be found slab by slab, in several processes. Hidden edges are left out if they are
// not wanted. Throws Cancelled.
GridBorders find_grid_borders(CellLayers layers, const Partition& partition, const voxel::Lattice& corners,
                              bool with_hidden, const Workers& workers, Progress* progress = nullptr);

}  // namespace ombre::surface
