// Solids of an OpenSCAD script that uses the words of .vcad.
#pragma once

#include <string>
#include <vector>

#include "design/node.h"

namespace ombre::lang {

// Solids of a script: those of polyhedra are leaves of the design graph.
struct WordSolid {
  std::string part;  // empty: none
  design::NodePtr node;
};
using WordSolids = std::vector<WordSolid>;

}  // namespace ombre::lang
