// Colours of a slicer's extruders, as stored in its project.
#include "formats/packages/extruder_colours.h"

#include <algorithm>
#include <charconv>

#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::formats {
namespace {

// Returns the value in a line "; key = value"; empty if there is none.
std::string_view value_of(std::string_view settings, std::string_view key) {
  while (!settings.empty()) {
    const size_t end = std::min(settings.find('\n'), settings.size());
    std::string_view line = trim(settings.substr(0, end));
    settings.remove_prefix(std::min(end + 1, settings.size()));
    if (line.starts_with(';')) line = trim(line.substr(1));
    const size_t equals = line.find('=');
    if (equals != std::string_view::npos && trim(line.substr(0, equals)) == key) return trim(line.substr(equals + 1));
  }
  return {};
}

// Parses a list such as "#FF0000;\"\";#0000FF".
std::vector<std::optional<Rgba>> colour_list(std::string_view text) {
  std::vector<std::optional<Rgba>> colours;
  if (text.empty()) return colours;
  for (const std::string& item : split(text, ';')) {
    std::string_view word = trim(item);
    if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = word.substr(1, word.size() - 2);
    colours.push_back(parse_colour(word));
  }
  return colours;
}

// Returns the number; 0 if the text is not a number.
uint64_t count_of(std::string_view text) {
  uint64_t value = 0;
  const std::string_view digits = trim(text);
  const auto [stop, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return status == std::errc() && stop == digits.data() + digits.size() ? value : 0;
}

}  // namespace

ExtruderColours ExtruderColours::of_bambu(std::string_view settings) {
  ExtruderColours extruders;
  Diagnostics unused;
  const auto data = parse_json(make_source("settings", std::string(settings)), unused);
  const Data* const colours = data ? data->find("filament_colour") : nullptr;
  if (!colours || !colours->list()) return extruders;
  for (const Data& colour : *colours->list())
    extruders.colours_.push_back(colour.string() ? parse_colour(trim(*colour.string())) : std::nullopt);
  return extruders;
}

ExtruderColours ExtruderColours::of_prusa(std::string_view settings) {
  ExtruderColours extruders;
  extruders.colours_ = colour_list(value_of(settings, "filament_colour"));
  const auto own = colour_list(value_of(settings, "extruder_colour"));
  if (own.size() > extruders.colours_.size()) extruders.colours_.resize(own.size());
  for (size_t i = 0; i < own.size(); ++i)
    if (own[i]) extruders.colours_[i] = own[i];
  return extruders;
}

void ExtruderColours::paint(std::vector<MeshGroup>& groups, uint64_t extruder) const {
  if (extruder == 0 || extruder > colours_.size()) return;
  for (MeshGroup& group : groups)
    if (!group.colour) group.colour = colours_[extruder - 1];
}

uint32_t ExtruderColours::paint_surfaces(std::vector<MeshGroup>& groups) const {
  uint32_t unknown = 0;
  for (MeshGroup& group : groups) {
    if (group.painted == 0) continue;
    group.material.clear();
    group.colour = group.painted <= colours_.size() ? colours_[group.painted - 1] : std::nullopt;
    if (!group.colour && unknown == 0) unknown = group.painted;
  }
  return unknown;
}

uint64_t extruder_of(std::string_view part, std::string_view object) {
  if (const uint64_t own = count_of(part)) return own;
  const uint64_t whole = count_of(object);
  return whole == 0 ? 1 : whole;
}

}  // namespace ombre::formats
