// Loads OpenSCAD scripts as designs, so that the views can show them.
#pragma once

#include <functional>
#include <string>

#include "load/loaded.h"

namespace ombre::studio {

// Runs the script and loads its solids, in the materials that they name, or else in those of the nearest colours.
// Echoes go to the echo of the options. Returns null, and adds diagnostics, when something is wrong. Throws Error and
// Cancelled.
compile::LoadedPtr load_scad(const SourcePtr& script, const compile::LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::studio
