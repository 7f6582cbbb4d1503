// Solids of an OpenSCAD script that uses words of .vcad.
#pragma once

#include <string>
#include <vector>

#include "design/node.h"

namespace ombre::lang {

// A solid of a script. Polyhedra are leaves of the design graph.
struct WordSolid {
  std::string part;  // empty if it belongs to no part
  design::NodePtr node;
};
using WordSolids = std::vector<WordSolid>;

}  // namespace ombre::lang
