// Every node there is.
#pragma once

#include "design/registry.h"

namespace ombre::nodes {

// All families, in the order of the palette.
const design::Registry& registry();

}  // namespace ombre::nodes
