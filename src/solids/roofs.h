// Roofs over regions.
#pragma once

#include "solids/solid.h"

namespace ombre::solids {

// Returns the closed mesh between a region and its roof, which rises at 45 degrees from the outline. Cones are
// approximated by planes that touch them, as many as the fragments ask for.
TriangleMesh roof_of(const Region& region, const Roof& by);

}  // namespace ombre::solids
