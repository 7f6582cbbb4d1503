#include "nodes/all_nodes.h"

#include "nodes/lattices/lattice_families.h"
#include "nodes/materials/material_families.h"
#include "nodes/solids/solid_families.h"
#include "nodes/values/value_families.h"

namespace ombre::nodes {

const design::Registry& registry() {
  static const design::Registry all = [] {
    design::Registry r;
    add_box_solids(r);
    add_round_solids(r);
    add_profiles(r);
    add_point_solids(r);
    add_text(r);
    add_implicit_solids(r);
    add_imported(r);
    add_relief(r);
    add_volumes(r);
    add_results(r);
    add_voxels(r);
    add_lattices(r);
    add_tiles(r);
    add_tpms(r);
    add_transforms(r);
    add_arrays(r);
    add_warps(r);
    add_booleans(r);
    add_sums(r);
    add_offsets(r);
    add_maps(r);
    add_material_gradients(r);
    add_attributes(r);
    add_parts(r);
    add_solid_of(r);
    add_supports(r);
    add_noise(r);
    add_value_nodes(r);
    add_value_places(r);
    add_value_cells(r);
    add_value_curves(r);
    add_value_colours(r);
    add_attribute_of(r);
    add_output_of(r);
    add_convolutions(r);
    add_whole_solids(r);
    return r;
  }();
  return all;
}

}  // namespace ombre::nodes
