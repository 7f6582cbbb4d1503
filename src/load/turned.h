// Turns a design to its orientation on the tray.
#pragma once

#include "base/text/diagnostic.h"
#include "load/loaded.h"

namespace ombre::compile {

// Returns the design turned by these degrees about x, then y, then z, around the origin, as rotate(angles, order="xyz")
// would turn it. A sampled box becomes the box around its turned corners. Returns null, and adds diagnostics, if it
// cannot be turned.
LoadedPtr turned(const LoadedPtr& loaded, Vec3 degrees, Diagnostics& diagnostics);

}  // namespace ombre::compile
