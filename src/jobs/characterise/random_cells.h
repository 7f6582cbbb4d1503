// Measures the cells of foams whose struts or walls a design makes from points.
#pragma once

#include <string>
#include <vector>

#include "base/text/data.h"
#include "design/design.h"
#include "jobs/characterise/spread.h"

namespace ombre::compile {

// The Voronoi cells of a node's points. Cells at the rim of the points, which extend to infinity, and their neighbours
// do not count.
struct RandomCells {
  std::string node;
  int line = 0;  // of the script; 0 if unknown
  size_t points = 0, cells = 0;
  Spread volume_mm3, faces;
  double edges_of_face = 0, edge_mm = 0;  // in the mean

  DataMembers data() const;
  std::string text() const;
};

// Returns the cells of each node of the design that makes Voronoi cells.
std::vector<RandomCells> random_cells_of(const design::Design& design);

}  // namespace ombre::compile
