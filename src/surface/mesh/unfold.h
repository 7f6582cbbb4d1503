// Moves vertices slightly where triangles are turned over.
#pragma once

#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

// Refreshes the surface, then moves vertices that are not part of a cluster if fewer triangles around them are folded
// afterwards.
void unfold(QuadSurface& surface);

}  // namespace ombre::surface
