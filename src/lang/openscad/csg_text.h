// Writes trees as .csg files, which OpenSCAD and Ombre read as scripts.
#pragma once

#include <string>

#include "solids/tree.h"

namespace ombre::lang::openscad {

enum class CsgForm : uint8_t {
  openscad,  // six digits, as OpenSCAD prints it
  exact      // all digits, and everything that OpenSCAD omits or does not know; reads back to the same tree
};

// Paths of imported files are written relative to `folder`. The root's group is left out unless it is marked or is not
// a group. Solids of Ombre's words are written as calls, after `use <ombre>`.
std::string csg_text(const solids::Tree& root, const std::string& folder, CsgForm form = CsgForm::openscad);

}  // namespace ombre::lang::openscad
