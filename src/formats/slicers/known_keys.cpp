#include "formats/slicers/known_keys.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text/text.h"

namespace ombre::formats {
namespace {

constexpr double any = std::numeric_limits<double>::infinity();

// Kinds of values, by the mark that follows a key in the lists below. Keys without one take other words.
constexpr std::pair<char, ValueKind> kinds[] = {
    {'#', {"a whole number, 0 or more", "3", {.is_whole = true, .least = 0}}},
    {'=', {"a number", "45", {.least = -any}}},
    {'~', {"a number, 0 or more", "0.4", {.least = 0}}},
    {'+', {"a number above 0", "0.2", {.least = 0, .is_above_least = true}}},
    {'/', {"a number, 0 or more, or a share in percent", "50%", {.takes_percent = true, .least = 0}}},
    {'%', {"a share from 0% to 100%", "20%", {.takes_percent = true, .least = 0, .most = 100}}},
};

constexpr std::string_view prusa_body_keys =
    "extruder automatic_infill_combination automatic_infill_combination_max_layer_height/ bridge_angle= "
    "bottom_solid_layers# bottom_solid_min_thickness~ bridge_flow_ratio~ bridge_speed~ "
    "ensure_vertical_shell_thickness over_bridge_speed/ top_fill_pattern bottom_fill_pattern "
    "external_perimeter_extrusion_width/ external_perimeter_speed/ enable_dynamic_overhang_speeds overhang_speed_0/ "
    "overhang_speed_1/ overhang_speed_2/ overhang_speed_3/ external_perimeters_first extra_perimeters "
    "extra_perimeters_on_overhangs fill_angle= fill_density% fill_pattern gyroid_optimized fuzzy_skin "
    "fuzzy_skin_thickness~ fuzzy_skin_point_dist~ gap_fill_enabled gap_fill_speed~ infill_anchor/ infill_anchor_max/ "
    "infill_extruder# infill_extrusion_width/ infill_every_layers# infill_overlap/ infill_speed~ ironing ironing_type "
    "ironing_flowrate/ ironing_spacing~ ironing_speed~ overhangs perimeter_extruder# perimeter_extrusion_width/ "
    "perimeter_speed~ perimeters# small_perimeter_speed/ solid_infill_below_area~ solid_infill_extruder# "
    "solid_infill_extrusion_width/ solid_infill_every_layers# solid_infill_speed/ thin_walls "
    "top_infill_extrusion_width/ top_solid_layers# top_solid_min_thickness~ top_solid_infill_speed/ wipe_into_infill "
    "top_one_perimeter_type only_one_perimeter_first_layer scarf_seam_placement scarf_seam_only_on_smooth "
    "scarf_seam_start_height scarf_seam_entire_loop scarf_seam_length scarf_seam_max_segment_length "
    "scarf_seam_on_inner_perimeters";

constexpr std::string_view prusa_object_keys =
    "brim_separation= brim_type brim_width~ dont_support_bridges elefant_foot_compensation= extrusion_width/ "
    "first_layer_acceleration_over_raft first_layer_speed_over_raft/ interface_shells layer_height+ "
    "mmu_segmented_region_max_width~ mmu_segmented_region_interlocking_depth~ raft_contact_distance~ raft_expansion= "
    "raft_first_layer_density% raft_first_layer_expansion= raft_layers# seam_position staggered_inner_seams "
    "slice_closing_radius~ slicing_mode perimeter_generator wall_transition_length/ wall_transition_filter_deviation/ "
    "wall_transition_angle wall_distribution_count# min_feature_size/ min_bead_width/ support_material "
    "support_material_auto support_material_angle= support_material_buildplate_only support_material_contact_distance "
    "support_material_bottom_contact_distance support_material_enforce_layers# support_material_extruder# "
    "support_material_extrusion_width/ support_material_interface_contact_loops support_material_interface_extruder# "
    "support_material_interface_layers# support_material_bottom_interface_layers support_material_interface_spacing~ "
    "support_material_interface_speed/ support_material_pattern support_material_interface_pattern "
    "support_material_closing_radius~ support_material_spacing~ support_material_speed~ support_material_style "
    "support_material_synchronize_layers support_material_threshold# support_material_with_sheath "
    "support_material_xy_spacing/ support_tree_angle support_tree_angle_slow support_tree_branch_diameter~ "
    "support_tree_branch_diameter_angle support_tree_branch_diameter_double_wall support_tree_top_rate/ "
    "support_tree_branch_distance~ support_tree_tip_diameter~ thick_bridges xy_size_compensation= wipe_into_objects "
    "interlocking_beam interlocking_beam_width~ interlocking_orientation= interlocking_beam_layer_count# "
    "interlocking_depth# interlocking_boundary_avoidance#";

// Keys that Bambu Studio and OrcaSlicer share.
constexpr std::string_view bambu_body_keys =
    "extruder bottom_shell_layers# bottom_shell_thickness~ bridge_angle= bridge_flow~ bridge_density/ "
    "counterbore_hole_bridging bridge_speed~ ensure_vertical_shell_thickness top_surface_pattern "
    "bottom_surface_pattern top_surface_density% bottom_surface_density% internal_solid_infill_pattern "
    "outer_wall_line_width/ outer_wall_speed~ infill_direction= symmetric_infill_y_axis infill_shift_step "
    "skeleton_infill_density% skin_infill_density% sparse_infill_density% fill_multiline# infill_lock_depth~ "
    "skin_infill_depth~ sparse_infill_pattern fuzzy_skin fuzzy_skin_thickness~ fuzzy_skin_point_distance~ "
    "fuzzy_skin_first_layer fuzzy_skin_noise_type fuzzy_skin_scale~ fuzzy_skin_octaves# fuzzy_skin_persistence~ "
    "fuzzy_skin_mode gap_infill_speed~ sparse_infill_line_width/ skin_infill_line_width/ skeleton_infill_line_width/ "
    "infill_wall_overlap/ sparse_infill_speed~ infill_combination ironing_type ironing_pattern ironing_flow/ "
    "ironing_spacing~ ironing_inset~ ironing_speed~ detect_overhang_wall inner_wall_line_width/ inner_wall_speed~ "
    "wall_loops# minimum_sparse_infill_area~ internal_solid_infill_line_width/ internal_solid_infill_speed~ "
    "detect_thin_wall top_surface_line_width/ top_shell_layers# top_shell_thickness~ top_surface_speed~ "
    "small_perimeter_speed/ small_perimeter_threshold~ wall_sequence enable_overhang_speed overhang_1_4_speed/ "
    "overhang_2_4_speed/ overhang_3_4_speed/ overhang_4_4_speed/ top_solid_infill_flow_ratio~ filter_out_gap_fill~ "
    "precise_outer_wall print_flow_ratio~ seam_slope_type seam_slope_conditional seam_slope_start_height/ "
    "seam_slope_entire_loop seam_slope_min_length seam_slope_steps# seam_slope_inner_walls alternate_extra_wall";

constexpr std::string_view bambu_only_body_keys =
    "overhang_totally_speed monotonic_travel_into_wall sub_top_surface_pattern sparse_infill_lattice_angle_1= "
    "sparse_infill_lattice_angle_2= infill_rotate_step locked_skin_infill_pattern locked_skeleton_infill_pattern "
    "sparse_infill_filament# ironing_direction smooth_speed_discontinuity_area smooth_coefficient wall_filament# "
    "solid_infill_filament# vertical_shell_speed top_color_penetration_layers# bottom_color_penetration_layers# "
    "infill_instead_top_bottom_surfaces enable_height_slowdown slowdown_start_height slowdown_start_speed "
    "slowdown_start_acc slowdown_end_height slowdown_end_speed slowdown_end_acc sparse_infill_anchor/ "
    "sparse_infill_anchor_max/ initial_layer_flow_ratio~ override_filament_scarf_seam_setting seam_slope_gap "
    "embedding_wall_into_infill";

constexpr std::string_view orca_only_body_keys =
    "internal_bridge_angle relative_bridge_angle bridge_line_width/ internal_bridge_flow~ internal_bridge_speed/ "
    "top_surface_fill_order bottom_surface_fill_order solid_infill_direction= top_layer_direction "
    "bottom_layer_direction solid_infill_rotate_template sparse_infill_rotate_template sparse_infill_smooth_factor "
    "lateral_lattice_angle_1= lateral_lattice_angle_2= infill_overhang_angle lightning_overhang_angle "
    "lightning_prune_angle lightning_straightening_angle align_infill_direction_to_model center_of_surface_pattern "
    "separated_infills extra_solid_infills fuzzy_skin_ripples_per_layer fuzzy_skin_ripple_offset "
    "fuzzy_skin_layers_between_ripple_offset sparse_infill_filament_id# top_bottom_infill_wall_overlap/ "
    "infill_combination_max_layer_height/ gyroid_optimized ironing_angle= ironing_angle_fixed unsupported_wall_last "
    "outer_wall_filament_id# inner_wall_filament_id# internal_solid_filament_id# top_surface_filament_id# "
    "bottom_surface_filament_id# top_surface_expansion top_surface_expansion_margin top_surface_expansion_direction "
    "only_one_wall_top min_width_top_surface only_one_wall_first_layer seam_gap role_based_wipe_speed wipe_speed "
    "wipe_on_loops wipe_inward wipe_inward_distance wipe_before_external_loop wall_infill_order "
    "small_support_perimeter_speed/ small_support_perimeter_threshold bottom_solid_infill_flow_ratio~ infill_anchor/ "
    "infill_anchor_max/ make_overhang_printable extra_perimeters_on_overhangs slowdown_for_curled_perimeters "
    "hole_to_polyhole hole_to_polyhole_threshold hole_to_polyhole_twisted hole_to_polyhole_max_edges overhang_reverse "
    "overhang_reverse_internal_only overhang_reverse_threshold is_infill_first small_area_infill_flow_compensation "
    "wall_direction first_layer_flow_ratio~ outer_wall_flow_ratio~ inner_wall_flow_ratio~ overhang_flow_ratio~ "
    "sparse_infill_flow_ratio~ internal_solid_infill_flow_ratio~ gap_fill_flow_ratio~ scarf_angle_threshold "
    "scarf_joint_speed scarf_joint_flow_ratio~ scarf_overhang_threshold";

constexpr std::string_view bambu_object_keys =
    "brim_object_gap= brim_type brim_width~ bridge_no_support elefant_foot_compensation= max_bridge_length~ "
    "line_width/ interface_shells layer_height+ mmu_segmented_region_max_width~ "
    "mmu_segmented_region_interlocking_depth~ raft_contact_distance~ raft_expansion= raft_first_layer_density% "
    "raft_first_layer_expansion= raft_layers# seam_position slice_closing_radius~ slicing_mode enable_support "
    "support_type support_angle= support_on_build_plate_only support_critical_regions_only "
    "support_remove_small_overhang support_top_z_distance~ support_bottom_z_distance~ enforce_support_layers# "
    "support_filament# support_line_width/ support_interface_not_for_body support_interface_loop_pattern "
    "support_interface_filament# support_interface_top_layers support_interface_bottom_layers "
    "support_interface_spacing~ support_interface_speed~ support_base_pattern support_interface_pattern "
    "support_base_pattern_spacing~ support_expansion= support_speed~ support_style thick_bridges "
    "support_threshold_angle# support_object_xy_distance support_object_first_layer_gap xy_hole_compensation= "
    "xy_contour_compensation= flush_into_objects flush_into_infill flush_into_support tree_support_branch_distance~ "
    "tree_support_branch_diameter~ tree_support_branch_angle tree_support_branch_diameter_angle "
    "tree_support_wall_count# detect_narrow_internal_solid_infill support_bottom_interface_spacing wall_generator "
    "wall_transition_length/ wall_transition_filter_deviation/ wall_transition_angle wall_distribution_count# "
    "min_feature_size/ min_bead_width/ precise_z_height interlocking_beam interlocking_beam_width~ "
    "interlocking_orientation= interlocking_beam_layer_count# interlocking_depth# interlocking_boundary_avoidance#";

std::vector<std::string_view> lists_of(SlicerFlavour flavour, KeyScope scope) {
  const bool is_for_body = scope == KeyScope::body;
  if (!is_of_bambu(flavour)) return {is_for_body ? prusa_body_keys : prusa_object_keys};
  if (!is_for_body) return {bambu_object_keys};
  return {bambu_body_keys, is_of_orca(flavour) ? orca_only_body_keys : bambu_only_body_keys};
}

const ValueKind* kind_marked(char mark) {
  const auto found = std::ranges::find(kinds, mark, &std::pair<char, ValueKind>::first);
  return found == std::end(kinds) ? nullptr : &found->second;
}

// Returns what follows the key in the list, whose words have a space between them: its mark, a space, or 0 at the end.
// Returns nothing if the list lacks the key.
std::optional<char> after(std::string_view list, std::string_view key) {
  for (size_t at = list.find(key); at != std::string_view::npos; at = list.find(key, at + 1)) {
    const size_t end = at + key.size();
    const char next = end == list.size() ? char{0} : list[end];
    const bool ends = next == 0 || next == ' ' || kind_marked(next);
    if (!key.empty() && ends && (at == 0 || list[at - 1] == ' ')) return next;
  }
  return std::nullopt;
}

bool is_word(std::string_view key) {
  return std::ranges::none_of(key, [](char c) { return c == ' ' || kind_marked(c); });
}

}  // namespace

bool ValueKind::takes(double number, std::string_view unit) const {
  if (!unit.empty() && !(unit == "%" && limits.takes_percent)) return false;
  if (limits.is_whole && number != std::floor(number)) return false;
  return number <= limits.most && (limits.is_above_least ? number > limits.least : number >= limits.least);
}

std::optional<KeyScope> scope_of(SlicerFlavour flavour, std::string_view key) {
  if (!is_word(key)) return std::nullopt;
  for (const KeyScope scope : {KeyScope::body, KeyScope::object})
    for (const std::string_view list : lists_of(flavour, scope))
      if (after(list, key)) return scope;
  return std::nullopt;
}

const ValueKind* kind_of(SlicerFlavour flavour, std::string_view key) {
  if (!is_word(key)) return nullptr;
  for (const KeyScope scope : {KeyScope::body, KeyScope::object})
    for (const std::string_view list : lists_of(flavour, scope))
      if (const auto mark = after(list, key)) return kind_marked(*mark);
  return nullptr;
}

std::vector<std::string> known_keys(SlicerFlavour flavour) {
  std::vector<std::string> keys;
  for (const KeyScope scope : {KeyScope::body, KeyScope::object})
    for (const std::string_view list : lists_of(flavour, scope))
      for (std::string& key : split(std::string(list), ' ')) {
        if (kind_marked(key.back())) key.pop_back();
        keys.push_back(std::move(key));
      }
  return keys;
}

}  // namespace ombre::formats
