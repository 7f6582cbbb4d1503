// The node types that designs are made of, for those who may not look into nodes/.
#pragma once

#include "design/registry.h"

namespace ombre::compile {

const design::Registry& node_registry();

}  // namespace ombre::compile
