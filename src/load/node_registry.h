// Gives the registry of node types to rooms that may not include nodes/.
#pragma once

#include "design/registry.h"

namespace ombre::compile {

const design::Registry& node_registry();

}  // namespace ombre::compile
