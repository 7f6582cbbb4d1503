#include "formats/mesh/slicer_settings.h"

#include <algorithm>

namespace ombre::formats {

std::span<const SlicerKey> slicer_keys() {
  static constexpr SlicerKey rows[] = {
      {"fill_density", "sparse_infill_density", "infill_density", true, "%"},
      {"fill_pattern", "sparse_infill_pattern", "", false, ""},
      {"perimeters", "wall_loops", "perimeters", true, ""},
      {"top_solid_layers", "top_shell_layers", "", true, ""},
      {"bottom_solid_layers", "bottom_shell_layers", "", true, ""},
      {"layer_height", "", "layer_height", false, ""},
      {"temperature", "nozzle_temperature", "temperature", true, ""},
      {"flow_rate", "", "flow_rate", false, ""},
      {"fuzzy_skin_thickness", "", "fuzzy_skin_thickness", false, ""},
      {"fuzzy_skin_point_dist", "fuzzy_skin_point_distance", "fuzzy_skin_point_distance", false, ""},
      {"extrusion_width", "line_width", "extrusion_width", false, ""},
      {"first_layer_extrusion_width", "initial_layer_line_width", "first_layer_extrusion_width", false, ""},
      {"perimeter_extrusion_width", "inner_wall_line_width", "perimeter_extrusion_width", false, ""},
      {"external_perimeter_extrusion_width", "outer_wall_line_width", "external_perimeter_extrusion_width", false, ""},
      {"infill_extrusion_width", "sparse_infill_line_width", "infill_extrusion_width", false, ""},
      {"solid_infill_extrusion_width", "internal_solid_infill_line_width", "solid_infill_extrusion_width", false, ""},
      {"top_infill_extrusion_width", "top_surface_line_width", "top_infill_extrusion_width", false, ""},
      {"support_material_extrusion_width", "support_line_width", "support_material_extrusion_width", false, ""},
      {"perimeter_speed", "inner_wall_speed", "perimeter_speed", false, ""},
      {"external_perimeter_speed", "outer_wall_speed", "external_perimeter_speed", false, ""},
      {"small_perimeter_speed", "", "small_perimeter_speed", false, ""},
      {"infill_speed", "sparse_infill_speed", "infill_speed", false, ""},
      {"solid_infill_speed", "internal_solid_infill_speed", "solid_infill_speed", false, ""},
      {"top_solid_infill_speed", "top_surface_speed", "top_solid_infill_speed", false, ""},
      {"gap_fill_speed", "gap_infill_speed", "gap_fill_speed", false, ""},
      {"bridge_speed", "", "bridge_speed", false, ""},
      {"ironing_speed", "", "ironing_speed", false, ""},
      {"ironing_flowrate", "ironing_flow", "ironing_flowrate", false, "%"},
  };
  return rows;
}

const SlicerKey* slicer_key_of(std::string_view attribute) {
  const auto found = std::ranges::find(slicer_keys(), attribute, &SlicerKey::attribute);
  return attribute.empty() || found == slicer_keys().end() ? nullptr : &*found;
}

std::string bambu_key(const std::string& prusa) {
  const auto found = std::ranges::find(slicer_keys(), prusa, &SlicerKey::prusa);
  return found == slicer_keys().end() || found->bambu.empty() ? prusa : std::string(found->bambu);
}

Settings slicer_settings(const MeshBody& body) {
  Settings settings = body.settings;
  const bool has_extruder =
      std::any_of(settings.begin(), settings.end(), [](const auto& setting) { return setting.first == "extruder"; });
  if (body.material && !has_extruder)
    settings.insert(settings.begin(), {"extruder", std::to_string(*body.material + 1)});
  return settings;
}

}  // namespace ombre::formats
