// Finds where nodes that make struts lie in a design.
#pragma once

#include <string>
#include <vector>

#include "design/design.h"

namespace ombre::compile {

// How a node's struts lie in the design, but for motions, which change no numbers of their graph. Maps have no offsets.
struct StrutPlace {
  const design::Node* node = nullptr;
  Affine cell_from_node;  // the cell: what the innermost tile above repeats, or else the node's frame
  Affine mm_from_cell;
  Vec3 steps;                        // in which a tile repeats the cell along its axes; 0: not at all
  std::string lengths_may_change;    // what may change lengths; empty: nothing
  std::string thickness_may_change;  // what may change radii; empty: nothing
};

// Returns the places of all nodes that make struts, without those that differ from another by a motion alone. The order
// is that of design::topological. Where a node is used in very many sizes, a place of unknown lengths stands for most.
std::vector<StrutPlace> strut_places(const design::Design& design);

}  // namespace ombre::compile
