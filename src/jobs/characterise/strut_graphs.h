// Counts the joints and struts of the lattices of a design.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "design/design.h"
#include "jobs/characterise/strut_joints.h"

namespace ombre::compile {

// LatticeGraph is the graph of a node of a design.
struct LatticeGraph {
  std::string node;
  int line = 0;  // of the script; 0 if unknown
  StrutGraph graph;
  std::optional<int64_t> maxwell_of_cell;  // of a cell that stands alone, if cells repeat
  bool knows_lengths = true;               // false where cells are bent

  DataMembers data() const;
  std::string text() const;
};

// Returns the graphs of all nodes of the design that make lattices of struts.
std::vector<LatticeGraph> lattice_graphs_of(const design::Design& design);

}  // namespace ombre::compile
