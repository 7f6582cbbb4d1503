// OpenSCAD scripts as designs, so that the views can show them.
#pragma once

#include <functional>
#include <string>

#include "load/loaded.h"

namespace ombre::studio {

// Runs the script and loads the solids that it makes, in the materials that they name, or else those of the nearest
// colours. What the script echoes goes to the options' echo. Null, and diagnostics, when something is wrong. Throws
// Error and Cancelled.
compile::LoadedPtr load_scad(const SourcePtr& script, const compile::LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::studio
