// Vertices moved a little where triangles look inwards.
#pragma once

#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

// Of vertices that stand for themselves, where fewer triangles around them are folded then. All that changed before is
// refreshed.
void unfold(QuadSurface& surface);

}  // namespace ombre::surface
