#include "nodes/all_nodes.h"

// Families of nodes in the order of the palette. Each file of a family defines add_<family>.
// clang-format off
#define OMBRE_NODE_FAMILIES(row)                                                                  \
  row(box_solids) row(round_solids) row(profiles) row(point_solids) row(text)                     \
  row(implicit_solids) row(imported) row(relief) row(volumes) row(results) row(voxels)            \
  row(lattices) row(tiles) row(tpms) row(cell_walls) row(point_lattices) row(transforms) row(arrays) row(warps)                       \
  row(booleans) row(sums) row(morphs) row(offsets) row(maps) row(material_gradients) row(attributes)          \
  row(parts) row(solid_of) row(supports) row(noise) row(value_nodes) row(value_places) row(random_points)         \
  row(value_cells) row(cell_maps) row(tpms_values) row(formula_cells) row(curve_cells) row(surface_cells) row(between_cells) \
  row(value_curves) row(value_colours) row(geodesic_distance) row(surface_coordinates) row(attribute_of) row(output_of)                                           \
  row(convolutions) row(whole_solids)
// clang-format on

namespace ombre::nodes {

#define OMBRE_ADD_FAMILY(family) void add_##family(design::Registry& registry);
OMBRE_NODE_FAMILIES(OMBRE_ADD_FAMILY)
#undef OMBRE_ADD_FAMILY

const design::Registry& registry() {
  static const design::Registry all = [] {
    design::Registry nodes;
#define OMBRE_ADD_FAMILY(family) add_##family(nodes);
    OMBRE_NODE_FAMILIES(OMBRE_ADD_FAMILY)
#undef OMBRE_ADD_FAMILY
    return nodes;
  }();
  return all;
}

}  // namespace ombre::nodes
