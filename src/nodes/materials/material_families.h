// The node families of this folder.
#pragma once

#include "design/registry.h"

namespace ombre::nodes {

void add_maps(design::Registry& registry);
void add_material_gradients(design::Registry& registry);

}  // namespace ombre::nodes
