// Trees as OpenSCAD writes them: .csg files, which OpenSCAD and Ombre read as scripts.
#pragma once

#include <string>

#include "solids/tree.h"

namespace ombre::lang::openscad {

// Paths of imported files are written as they lead from `folder`. Numbers have six digits, as OpenSCAD has them: for
// exact geometry keep the tree itself. The root's group is left out unless it is marked or is not a group.
std::string csg_text(const solids::Tree& root, const std::string& folder);

}  // namespace ombre::lang::openscad
