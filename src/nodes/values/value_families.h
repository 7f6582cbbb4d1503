// The node families of this folder.
#pragma once

#include "design/registry.h"

namespace ombre::nodes {

void add_results(design::Registry& registry);
void add_attributes(design::Registry& registry);
void add_noise(design::Registry& registry);
void add_value_nodes(design::Registry& registry);
void add_value_places(design::Registry& registry);
void add_value_cells(design::Registry& registry);
void add_value_curves(design::Registry& registry);
void add_value_colours(design::Registry& registry);
void add_attribute_of(design::Registry& registry);
void add_output_of(design::Registry& registry);
void add_solid_of(design::Registry& registry);

}  // namespace ombre::nodes
