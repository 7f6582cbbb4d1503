// The registry of all nodes.
#pragma once

#include "design/registry.h"

namespace ombre::nodes {

// Returns all families of nodes, in the order of the palette.
const design::Registry& registry();

}  // namespace ombre::nodes
