// A design as it lies on the tray.
#pragma once

#include "base/text/diagnostic.h"
#include "load/loaded.h"

namespace ombre::compile {

// The design turned about x, then y, then z, by these degrees, around the origin: what rotate(angles, order="xyz")
// around all of it would make. Of a box that is sampled the box around it counts. Null, and diagnostics, where it
// cannot be.
LoadedPtr turned(const LoadedPtr& loaded, Vec3 degrees, Diagnostics& diagnostics);

}  // namespace ombre::compile
