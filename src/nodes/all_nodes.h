// Every node family, in palette order.
#pragma once

#include "design/registry.h"

namespace ombre::nodes {

void add_box_solids(design::Registry& registry);
void add_round_solids(design::Registry& registry);
void add_profiles(design::Registry& registry);
void add_point_solids(design::Registry& registry);
void add_text(design::Registry& registry);
void add_implicit_solids(design::Registry& registry);
void add_imported(design::Registry& registry);
void add_relief(design::Registry& registry);
void add_volumes(design::Registry& registry);
void add_results(design::Registry& registry);
void add_voxels(design::Registry& registry);
void add_lattices(design::Registry& registry);
void add_tiles(design::Registry& registry);
void add_tpms(design::Registry& registry);
void add_transforms(design::Registry& registry);
void add_arrays(design::Registry& registry);
void add_warps(design::Registry& registry);
void add_booleans(design::Registry& registry);
void add_sums(design::Registry& registry);
void add_offsets(design::Registry& registry);
void add_maps(design::Registry& registry);
void add_material_gradients(design::Registry& registry);
void add_attributes(design::Registry& registry);
void add_parts(design::Registry& registry);
void add_supports(design::Registry& registry);
void add_noise(design::Registry& registry);
void add_value_nodes(design::Registry& registry);
void add_value_places(design::Registry& registry);
void add_value_cells(design::Registry& registry);
void add_value_curves(design::Registry& registry);
void add_value_colours(design::Registry& registry);
void add_attribute_of(design::Registry& registry);
void add_convolutions(design::Registry& registry);
void add_whole_solids(design::Registry& registry);

// All of the above.
const design::Registry& registry();

}  // namespace ombre::nodes
