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
  std::string no_lengths, no_slenderness;  // why these are not known; empty: they are known

  bool knows_lengths() const { return graph.struts > 0 && no_lengths.empty(); }
  bool knows_slenderness() const { return knows_lengths() && no_slenderness.empty(); }

  DataMembers data() const;
  std::string text() const;
};

// Returns the graphs of all nodes of the design that make lattices of struts. A node that is used in several ways that
// differ in the numbers they print, such as two scales, has several. Struts that clearly lie outside of their node's
// region do not count.
std::vector<LatticeGraph> lattice_graphs_of(const design::Design& design);

}  // namespace ombre::compile
