// Loads OpenSCAD scripts as designs, so that the views can show them.
#pragma once

#include <functional>
#include <string>

#include "load/loaded.h"

namespace ombre::studio {

// Runs the script and loads its solids, with the materials that they name, or those of the nearest colours. Its echo
// output goes to the options' echo. Returns null, with diagnostics, if it fails. Throws Error and Cancelled.
compile::LoadedPtr load_scad(const SourcePtr& script, const compile::LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::studio
