// The node families of this folder.
#pragma once

#include "design/registry.h"

namespace ombre::nodes {

void add_point_solids(design::Registry& registry);
void add_implicit_solids(design::Registry& registry);
void add_voxels(design::Registry& registry);
void add_lattices(design::Registry& registry);
void add_tiles(design::Registry& registry);
void add_tpms(design::Registry& registry);
void add_arrays(design::Registry& registry);

}  // namespace ombre::nodes
