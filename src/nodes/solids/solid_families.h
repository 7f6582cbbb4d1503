// The node families of this folder.
#pragma once

#include "design/registry.h"

namespace ombre::nodes {

void add_box_solids(design::Registry& registry);
void add_round_solids(design::Registry& registry);
void add_profiles(design::Registry& registry);
void add_text(design::Registry& registry);
void add_imported(design::Registry& registry);
void add_relief(design::Registry& registry);
void add_volumes(design::Registry& registry);
void add_transforms(design::Registry& registry);
void add_warps(design::Registry& registry);
void add_booleans(design::Registry& registry);
void add_offsets(design::Registry& registry);
void add_supports(design::Registry& registry);
void add_convolutions(design::Registry& registry);
void add_sums(design::Registry& registry);
void add_parts(design::Registry& registry);
void add_whole_solids(design::Registry& registry);

}  // namespace ombre::nodes
