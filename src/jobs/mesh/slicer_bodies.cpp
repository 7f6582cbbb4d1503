#include "jobs/mesh/slicer_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/text/text.h"
#include "formats/slicers/known_keys.h"
#include "formats/slicers/slicer_settings.h"
#include "questions/build.h"
#include "questions/region_survey.h"

namespace ombre::jobs {
namespace {

using compile::MeshChoices;
using formats::Settings;
using formats::SlicerFlavour;

// Returns the setting of bodies that an attribute sets in the program; empty if there is none.
std::string body_key_of(const std::string& attribute, SlicerFlavour flavour) {
  const formats::SlicerKey* row = formats::slicer_key_of(attribute);
  if (!row) return "";
  const std::string key(row->prusa.empty() ? row->bambu : row->prusa);
  const bool is_of_body = formats::scope_of(flavour, formats::key_in(flavour, key)) == formats::KeyScope::body;
  return is_of_body ? key : "";
}

// Adds the settings of the middles of a body's bands, unless others were given.
void add_attributes(const compile::Region& region, SlicerFlavour flavour, Settings& values) {
  for (const auto& [attribute, middle] : region.attributes) {
    const std::string key = body_key_of(attribute, flavour);
    const auto is_given = [&](const auto& value) { return value.first == key; };
    if (key.empty() || std::ranges::any_of(values, is_given)) continue;
    values.emplace_back(key, setting_of_band(attribute, key, flavour, middle));
  }
}

Settings settings_of(const std::vector<SlicerSetting>& settings, size_t body, const compile::MeshedDesign& made,
                     const MeshChoices& choices) {
  Settings values;
  for (const SlicerSetting& setting : settings) {
    if (setting.listed() > 0 && setting.listed() != made.bodies.size())
      throw WrongArgument(spelled::option("--setting", setting.key()) + " lists " + std::to_string(setting.listed()) +
                          " values, and there are " + std::to_string(made.bodies.size()) + " bodies");
    if (setting.is_of_object(choices.flavour)) continue;
    values.emplace_back(setting.key(), setting.value(choices.flavour, body, made.bodies[body].share));
  }
  add_attributes(made.bodies[body].region, choices.flavour, values);
  // Bodies of materials and parts have an extruder each, in their order; bands share one.
  const bool is_given = std::ranges::any_of(settings, [](const SlicerSetting& s) { return s.key() == "extruder"; });
  if (!is_given && !made.bodies[body].region.material && choices.regions.by != "parts")
    values.emplace_back("extruder", "1");
  return values;
}

using Middles = std::set<double>;

// Returns the middles of an attribute's bands, by the settings that slicers take for them.
std::map<std::string, Middles> middles_by_setting(const compile::MeshedDesign& made, const std::string& attribute,
                                                  SlicerFlavour flavour) {
  const std::string key = body_key_of(attribute, flavour);
  std::map<std::string, Middles> middles;
  for (const compile::RegionBody& body : made.bodies)
    for (const auto& [own, middle] : body.region.attributes)
      if (own == attribute) middles[setting_of_band(attribute, key, flavour, middle)].insert(middle);
  return middles;
}

// Warns of bands whose middles become the same setting, as where slicers take whole numbers for it.
void tell_rounded_bands(const Events& events, const compile::MeshedDesign& made, const MeshChoices& choices,
                        const std::string& attribute) {
  const std::string key = formats::key_in(choices.flavour, body_key_of(attribute, choices.flavour));
  std::vector<std::string> equal;
  for (const auto& [setting, middles] : middles_by_setting(made, attribute, choices.flavour)) {
    if (middles.size() < 2) continue;
    std::vector<std::string> texts;
    for (const double middle : middles) texts.push_back(format_rounded(middle));
    std::string text = "those around " + join(texts, ", ");
    equal.push_back(std::move(text.append(" have ").append(key).append("=").append(setting)));
  }
  if (equal.empty()) return;
  events.warn("bands of " + attribute + " become the same setting: " + join(equal, ", ") +
              "; choose fewer bands, or values that are further apart");
}

// Returns the attributes that bands of the design have and --setting does not choose.
std::set<std::string> attributes_of(const compile::MeshedDesign& made, const MeshChoices& choices) {
  std::set<std::string> given, attributes;
  for (const std::string& setting : choices.settings) given.insert(SlicerSetting(setting).key());
  for (const compile::RegionBody& body : made.bodies)
    for (const auto& [attribute, middle] : body.region.attributes)
      if (formats::slicer_key_of(attribute) && !given.contains(body_key_of(attribute, choices.flavour)))
        attributes.insert(attribute);
  return attributes;
}

}  // namespace

std::string setting_of_band(const std::string& attribute, const std::string& key, SlicerFlavour flavour,
                            double middle) {
  const formats::SlicerKey& row = *formats::slicer_key_of(attribute);
  const double number = row.is_whole ? std::round(middle) : middle;
  const std::string text = format_rounded(number, 4) + std::string(row.unit), name = formats::key_in(flavour, key);
  const formats::ValueKind* const kind = formats::kind_of(flavour, name);
  if (kind && !kind->takes(number, row.unit == "%" ? "%" : ""))
    throw WrongArgument("a band of the attribute " + attribute + " would have " + name + "=" + text +
                        ", and this setting is " + std::string(kind->name) +
                        "; change the attribute's values, or give it a name of your own");
  return text;
}

formats::MeshDocument document_of(compile::MeshedDesign& made, const std::string& title, const MeshChoices& choices,
                                  const std::vector<SlicerSetting>& settings) {
  formats::MeshDocument document;
  document.title = title;
  for (size_t n = 0; n < made.bodies.size(); ++n) {
    compile::RegionBody& body = made.bodies[n];
    const std::string name = made.bodies.size() == 1 && body.region.name.empty() ? title : body.region.name;
    formats::MeshBody written;
    written.name = name;
    written.settings = settings_of(settings, n, made, choices);
    written.material = static_cast<uint32_t>(n);
    document.materials.push_back({name, body.colour});
    written.vertices = std::move(body.body.vertices);
    written.triangles = std::move(body.body.triangles);
    document.bodies.push_back(std::move(written));
  }
  for (const SlicerSetting& setting : settings)
    if (setting.is_of_object(choices.flavour))
      document.project.object_settings.emplace_back(setting.key(), setting.value(choices.flavour, 0, 0));
  return document;
}

void tell_lost_attributes(const Events& events, const compile::MeshedDesign& made, const MeshChoices& choices) {
  for (const std::string& attribute : attributes_of(made, choices)) {
    if (!body_key_of(attribute, choices.flavour).empty()) {
      tell_rounded_bands(events, made, choices, attribute);
      continue;
    }
    const bool is_of_tool = attribute == "temperature" || attribute == "flow_rate";
    if (is_of_tool && choices.virtual_tools) continue;
    Phrase remedy("");
    if (is_of_tool) remedy = "; " + spelled::option("--virtual-tools") + " gives each value a tool of its own";
    if (attribute == "layer_height") remedy = "; " + spelled::option("--height-ranges") + " can have it by height";
    events.warn(attribute + " is no setting of a body in " +
                std::string(formats::program_of(choices.flavour == SlicerFlavour::generic ? SlicerFlavour::prusa
                                                                                          : choices.flavour)) +
                ", so the file does not have it" + remedy);
  }
}

void name_only_filament(const compile::Loaded& loaded, const Events& events, Diagnostics& diagnostics,
                        formats::MeshDocument& document) {
  const auto has_first = [](const formats::MeshBody& body) { return formats::body_extruder(body) == 1; };
  if (!document.project.filaments.empty() || document.bodies.empty() ||
      !std::ranges::all_of(document.bodies, has_first))
    return;
  const auto box = compile::design_box(loaded.design, diagnostics);
  const auto inside = box ? compile::find_materials(loaded.design, *box, 1, diagnostics) : std::nullopt;
  if (!inside || inside->names.empty()) return;
  const bool is_one = inside->names.size() == 1;
  const formats::Rgba colour =
      is_one ? loaded.design.materials.find(inside->names[0])->colour : document.materials.front().colour;
  document.project.filaments = {{join(inside->names, " and "), colour, {}, {}}};
  if (!is_one) events.say("the bodies have one filament for " + join(inside->names, " and "));
}

void tell_equal_bands(const Events& events, const compile::MeshedDesign& made, const MeshChoices& choices,
                      const formats::MeshDocument& document) {
  if (!formats::is_project(choices.flavour) || made.bodies.size() < 2) return;
  for (size_t n = 0; n < made.bodies.size(); ++n)
    if (made.bodies[n].region.fractions.empty() || document.bodies[n].settings != document.bodies[0].settings) return;
  events.warn("the bands of the mixture have one filament and the same settings, so " +
              std::string(formats::program_of(choices.flavour)) + " prints them alike; " +
              spelled::option("--mix-layers", "4") + " mixes filaments, " +
              spelled::option("--setting", "fill_density=10%..60%") + " grades the infill");
}

}  // namespace ombre::jobs
