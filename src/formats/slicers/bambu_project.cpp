#include "formats/slicers/bambu_project.h"

#include <cmath>
#include <functional>
#include <span>

#include "base/text/json.h"
#include "base/text/text.h"
#include "formats/containers/xml_text.h"
#include "formats/slicers/project_filaments.h"
#include "formats/slicers/snapmaker_mixtures.h"

namespace ombre::formats {
namespace {

// All values are texts or lists of texts. Lists have an item for each filament, mixtures last.
class ProjectSettings {
 public:
  ProjectSettings(const MeshDocument& document, std::span<const FilamentMixture> mixtures)
      : filaments_(project_filaments(document)), mixtures_(mixtures) {}

  void set(const std::string& key, Data value) { settings_.emplace_back(key, std::move(value)); }
  void add(const std::string& key, const std::function<std::string(const Filament&)>& of_filament,
           const std::function<std::string(const FilamentMixture&)>& of_mixture) {
    DataList values;
    for (const Filament& filament : filaments_) values.emplace_back(of_filament(filament));
    for (const FilamentMixture& mixture : mixtures_) values.emplace_back(of_mixture(mixture));
    set(key, std::move(values));
  }
  // Adds a value for each filament, with that of a mixture's first part for the mixture.
  void add(const std::string& key, const std::function<std::string(const Filament&)>& value) {
    add(key, value, [&](const FilamentMixture& mixture) { return value(filaments_[mixture.parts[0].extruder - 1]); });
  }
  void add_mixtures();
  void add_one_nozzle();
  std::string text() const { return print_json(settings_); }

 private:
  std::vector<Filament> filaments_;
  std::span<const FilamentMixture> mixtures_;
  DataMembers settings_;
};

std::string components_of(const FilamentMixture& mixture) {
  std::vector<std::string> extruders;
  for (const FilamentMixture::Part& part : mixture.parts) extruders.push_back(std::to_string(part.extruder));
  return join(extruders, ",");
}

// Returns shares of four decimals that add up to 1; the last one takes what rounding leaves.
std::string ratios_of(const FilamentMixture& mixture) {
  constexpr int units = 10000;
  std::vector<std::string> texts;
  int left = units;
  const std::vector<double> shares = shares_of(mixture);
  for (size_t n = 0; n < shares.size(); ++n) {
    const int share = n + 1 == shares.size() ? left : static_cast<int>(std::lround(shares[n] * units));
    left -= share;
    const std::string digits = std::to_string(units + share);
    texts.push_back((share == units ? "1." : "0.") + digits.substr(1));
  }
  return join(texts, ",");
}

void ProjectSettings::add_mixtures() {
  const auto same = [](const std::string& text) { return [text](const auto&) { return text; }; };
  add("filament_is_mixed", same("0"), same("1"));
  add("filament_mixed_components", same(""), components_of);
  add("filament_mixed_sublayer_ratios", same(""), ratios_of);
  add("filament_mixed_gradient", same("0"), same("0"));
  add("filament_mixed_gradient_range", same(""), same(""));
  add("filament_mixed_gradient_curve", same(""), same(""));
  add("filament_mixed_gradient_per_part", same("0"), same("0"));
}

void ProjectSettings::add_one_nozzle() {
  set("single_extruder_multi_material", "1");
  set("enable_prime_tower", "0");
  add("nozzle_temperature", nozzle_temperature);
  add("nozzle_temperature_initial_layer", nozzle_temperature);
  add("filament_start_gcode", flow_code);
  add("filament_end_gcode", [](const Filament&) { return std::string(usual_flow_code); });
}

}  // namespace

std::string bambu_version(const MeshDocument& document, SlicerFlavour flavour) {
  const bool mixes = !document.project.mixtures.empty() && flavour != SlicerFlavour::snapmaker;
  return mixes ? "02.06.00.00" : "02.00.00.00";
}

std::string bambu_project(const MeshDocument& document, SlicerFlavour flavour) {
  constexpr uint8_t opaque = 255;
  const std::vector<FilamentMixture>& mixtures = document.project.mixtures;
  const bool are_filaments = flavour != SlicerFlavour::snapmaker;
  ProjectSettings settings(document, std::span(mixtures).first(are_filaments ? mixtures.size() : 0));
  settings.set("version", bambu_version(document, flavour));
  settings.set("from", "project");
  settings.set("name", "project_settings");
  settings.set("printer_settings_id", "ombre");
  settings.set("print_settings_id", "ombre");
  settings.set("printable_area", DataList{"0x0", "256x0", "256x256", "0x256"});
  settings.set("printable_height", "256");
  settings.set("nozzle_diameter", DataList{"0.4"});
  const auto colour = [](const auto& filament) {
    return filament.colour[3] == opaque ? opaque_colour(filament.colour) : hex_colour(filament.colour);
  };
  const auto name = [](const auto& filament) { return filament.name; };
  settings.add("filament_colour", colour, colour);
  settings.add("filament_settings_id", name, name);
  settings.add("filament_type", filament_type);
  if (!mixtures.empty() && are_filaments) settings.add_mixtures();
  if (!mixtures.empty() && !are_filaments) settings.set("mixed_filament_definitions", snapmaker_mixtures(mixtures));
  if (document.project.has_one_nozzle && is_of_orca(flavour)) settings.add_one_nozzle();
  return settings.text();
}

}  // namespace ombre::formats
