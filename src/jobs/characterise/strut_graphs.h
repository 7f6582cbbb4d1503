// Counts the joints and struts of the lattices of a design.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/math/vec.h"
#include "base/text/data.h"
#include "design/design.h"
#include "jobs/characterise/spread.h"

namespace ombre::compile {

struct GraphStrut {
  Vec3 start, end;    // mm, or cells where these are bent
  double radius = 0;  // mm; 0: not known
};

// A graph of struts, of which those that go on straight from one to the next count as one.
struct StrutGraph {
  size_t joints = 0, struts = 0;
  std::map<size_t, size_t> joints_of_degree;  // by the number of struts that meet at them
  Spread length, slenderness;                 // slenderness: 2 L / r, the length over the radius of gyration

  // Struts - 3 joints + 6: below 0, struts on joints that are pins cannot be rigid (Maxwell 1864).
  int64_t maxwell() const { return static_cast<int64_t>(struts) - 3 * static_cast<int64_t>(joints) + 6; }
};

// Returns the graph. Where `period` is above 0, struts repeat without end along that axis, and the graph is that of one
// period.
StrutGraph graph_of(const std::vector<GraphStrut>& struts, Vec3 period = {});

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
