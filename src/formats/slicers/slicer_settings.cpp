#include "formats/slicers/slicer_settings.h"

#include <algorithm>

#include "base/text/text.h"
#include "formats/slicers/known_keys.h"

namespace ombre::formats {

std::span<const SlicerKey> slicer_keys() {
  static constexpr SlicerKey rows[] = {
      {"fill_density", "sparse_infill_density", "infill_density", true, "%"},
      {"fill_pattern", "sparse_infill_pattern", "", false, ""},
      {"fill_angle", "infill_direction", "", false, ""},
      {"perimeters", "wall_loops", "perimeters", true, ""},
      {"top_solid_layers", "top_shell_layers", "", true, ""},
      {"bottom_solid_layers", "bottom_shell_layers", "", true, ""},
      {"top_solid_min_thickness", "top_shell_thickness", "", false, ""},
      {"bottom_solid_min_thickness", "bottom_shell_thickness", "", false, ""},
      {"top_fill_pattern", "top_surface_pattern", "", false, ""},
      {"bottom_fill_pattern", "bottom_surface_pattern", "", false, ""},
      {"layer_height", "layer_height", "layer_height", false, ""},
      {"", "", "temperature", true, ""},
      {"", "print_flow_ratio", "flow_rate", false, ""},
      {"fuzzy_skin_thickness", "fuzzy_skin_thickness", "fuzzy_skin_thickness", false, ""},
      {"fuzzy_skin_point_dist", "fuzzy_skin_point_distance", "fuzzy_skin_point_distance", false, ""},
      {"extrusion_width", "line_width", "extrusion_width", false, ""},
      {"", "", "first_layer_extrusion_width", false, ""},
      {"perimeter_extrusion_width", "inner_wall_line_width", "perimeter_extrusion_width", false, ""},
      {"external_perimeter_extrusion_width", "outer_wall_line_width", "external_perimeter_extrusion_width", false, ""},
      {"infill_extrusion_width", "sparse_infill_line_width", "infill_extrusion_width", false, ""},
      {"solid_infill_extrusion_width", "internal_solid_infill_line_width", "solid_infill_extrusion_width", false, ""},
      {"top_infill_extrusion_width", "top_surface_line_width", "top_infill_extrusion_width", false, ""},
      {"support_material_extrusion_width", "support_line_width", "support_material_extrusion_width", false, ""},
      {"support_material", "enable_support", "", false, ""},
      {"perimeter_speed", "inner_wall_speed", "perimeter_speed", false, ""},
      {"external_perimeter_speed", "outer_wall_speed", "external_perimeter_speed", false, ""},
      {"small_perimeter_speed", "small_perimeter_speed", "small_perimeter_speed", false, ""},
      {"infill_speed", "sparse_infill_speed", "infill_speed", false, ""},
      {"solid_infill_speed", "internal_solid_infill_speed", "solid_infill_speed", false, ""},
      {"top_solid_infill_speed", "top_surface_speed", "top_solid_infill_speed", false, ""},
      {"gap_fill_speed", "gap_infill_speed", "gap_fill_speed", false, ""},
      {"bridge_speed", "bridge_speed", "bridge_speed", false, ""},
      {"ironing_speed", "ironing_speed", "ironing_speed", false, ""},
      {"ironing_flowrate", "ironing_flow", "ironing_flowrate", false, "%"},
  };
  return rows;
}

const SlicerKey* slicer_key_of(std::string_view attribute) {
  const auto found = std::ranges::find(slicer_keys(), attribute, &SlicerKey::attribute);
  return attribute.empty() || found == slicer_keys().end() ? nullptr : &*found;
}

std::string key_in(SlicerFlavour flavour, std::string_view key) {
  if (is_of_bambu(flavour)) {
    const auto found = std::ranges::find(slicer_keys(), key, &SlicerKey::prusa);
    if (!key.empty() && found != slicer_keys().end()) key = found->bambu;
  }
  return scope_of(flavour, key) ? std::string(key) : "";
}

Settings in_words_of(SlicerFlavour flavour, const Settings& settings) {
  Settings translated;
  for (const auto& [key, value] : settings)
    if (std::string own = key_in(flavour, key); !own.empty()) translated.emplace_back(std::move(own), value);
  return translated;
}

Settings slicer_settings(const MeshBody& body, SlicerFlavour flavour) {
  Settings settings = in_words_of(flavour, body.settings);
  const bool has_extruder = std::ranges::any_of(settings, [](const auto& own) { return own.first == "extruder"; });
  if (body.material && !has_extruder)
    settings.insert(settings.begin(), {"extruder", std::to_string(*body.material + 1)});
  return settings;
}

uint32_t body_extruder(const MeshBody& body) {
  for (const auto& [key, value] : body.settings)
    if (key == "extruder") return static_cast<uint32_t>(parse_number(value).value_or(1));
  return body.material.value_or(0) + 1;
}

void set_extruder(MeshBody& body, size_t extruder) {
  std::erase_if(body.settings, [](const auto& setting) { return setting.first == "extruder"; });
  body.settings.emplace_back("extruder", std::to_string(extruder));
}

}  // namespace ombre::formats
