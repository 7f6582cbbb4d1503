// The names of the families of nodes: what each file of nodes adds to the registry.
#pragma once

#include "design/registry.h"

// A row for each family, in the order of the palette.
// clang-format off
#define OMBRE_NODE_FAMILIES(row)                                                                  \
  row(box_solids) row(round_solids) row(profiles) row(point_solids) row(text)                     \
  row(implicit_solids) row(imported) row(relief) row(volumes) row(results) row(voxels)            \
  row(lattices) row(tiles) row(tpms) row(transforms) row(arrays) row(warps)                       \
  row(booleans) row(sums) row(offsets) row(maps) row(material_gradients) row(attributes)          \
  row(parts) row(solid_of) row(supports) row(noise) row(value_nodes) row(value_places)            \
  row(value_cells) row(value_curves) row(value_colours) row(attribute_of) row(output_of)          \
  row(convolutions) row(whole_solids)
// clang-format on

namespace ombre::nodes {

#define OMBRE_ADD_FAMILY(family) void add_##family(design::Registry& registry);
OMBRE_NODE_FAMILIES(OMBRE_ADD_FAMILY)
#undef OMBRE_ADD_FAMILY

}  // namespace ombre::nodes
