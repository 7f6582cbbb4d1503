#include "design/attributes.h"

#include <algorithm>

#include "base/system/assert.h"
#include "base/text/text.h"

namespace ombre::design {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
const Interval from_zero{0, endless}, any_number = Interval::everything(), one{0, 1};

// Standard attributes. Units are those of the processes that use the values.
const StandardAttribute table[] = {
    {"modulus", ValueType::number, "MPa", from_zero, 0, "Young's modulus"},
    {"poissons_ratio", ValueType::number, "1", {-1, 0.5}, 0, "Poisson's ratio"},
    {"shore_hardness", ValueType::number, "Shore A", {0, 100}, 0, "indentation hardness"},
    {"toughness", ValueType::number, "MJ/m3", from_zero, 0, "energy to break a unit of volume"},
    {"elongation", ValueType::number, "%", from_zero, 0, "elongation at break"},
    {"density", ValueType::number, "g/cm3", from_zero, 0, "mass of a unit of volume"},
    {"hu", ValueType::number, "HU", any_number, 0, "radiodensity on the scale of Hounsfield"},
    {"temperature",
     ValueType::number,
     "\xC2\xB0"
     "C",
     {-273.15, endless},
     0,
     "of the nozzle, or of the part"},
    {"dose", ValueType::number, "mJ/cm2", from_zero, 0, "energy of light for each layer"},
    {"cure_depth", ValueType::number, "mm", from_zero, 0, "to which light cures a resin"},
    {"intensity", ValueType::number, "1", one, 1, "share of a projector's light"},
    {"flow_rate", ValueType::number, "1", from_zero, 1, "factor on what a nozzle extrudes"},
    {"infill_density", ValueType::number, "%", {0, 100}, 0, "share of the inside that a slicer fills"},
    {"layer_height", ValueType::number, "mm", from_zero, 0, "thickness of a slicer's layers"},
    {"perimeters", ValueType::number, "1", from_zero, 0, "number of walls along a layer's outline"},
    {"fuzzy_skin_thickness", ValueType::number, "mm", from_zero, 0, "how far a fuzzy wall strays"},
    {"fuzzy_skin_point_distance", ValueType::number, "mm", from_zero, 0, "between points of a fuzzy wall"},
    {"extrusion_width", ValueType::number, "mm", from_zero, 0, "of a slicer's lines"},
    {"perimeter_extrusion_width", ValueType::number, "mm", from_zero, 0, "of lines of walls"},
    {"external_perimeter_extrusion_width", ValueType::number, "mm", from_zero, 0, "of lines of outer walls"},
    {"infill_extrusion_width", ValueType::number, "mm", from_zero, 0, "of lines of the infill"},
    {"solid_infill_extrusion_width", ValueType::number, "mm", from_zero, 0, "of lines of solid infill"},
    {"top_infill_extrusion_width", ValueType::number, "mm", from_zero, 0, "of lines of top layers"},
    {"support_material_extrusion_width", ValueType::number, "mm", from_zero, 0, "of lines of supports"},
    {"perimeter_speed", ValueType::number, "mm/s", from_zero, 0, "along walls"},
    {"external_perimeter_speed", ValueType::number, "mm/s", from_zero, 0, "along outer walls"},
    {"small_perimeter_speed", ValueType::number, "mm/s", from_zero, 0, "along small walls"},
    {"infill_speed", ValueType::number, "mm/s", from_zero, 0, "in the infill"},
    {"solid_infill_speed", ValueType::number, "mm/s", from_zero, 0, "in solid infill"},
    {"top_solid_infill_speed", ValueType::number, "mm/s", from_zero, 0, "in top layers"},
    {"gap_fill_speed", ValueType::number, "mm/s", from_zero, 0, "in gaps"},
    {"bridge_speed", ValueType::number, "mm/s", from_zero, 0, "over air"},
    {"ironing_speed", ValueType::number, "mm/s", from_zero, 0, "while ironing"},
    {"ironing_flowrate", ValueType::number, "%", from_zero, 0, "of what ironing extrudes"},
    {"laser_power", ValueType::number, "W", from_zero, 0, "of a beam that melts"},
    {"scan_speed", ValueType::number, "mm/s", from_zero, 0, "of a beam along its line"},
    {"hatch_spacing", ValueType::number, "mm", from_zero, 0, "between a beam's lines"},
    {"wire_feed", ValueType::number, "mm/s", from_zero, 0, "of wire into a melt pool"},
    {"color_rgb", ValueType::vector, "1", one, 0, "red, green and blue, in sRGB"},
    {"color_rgba", ValueType::colour, "1", one, 0, "red, green, blue and alpha, in sRGB"},
};

constexpr std::string_view vector_parts[] = {".x", ".y", ".z"}, colour_parts[] = {".r", ".g", ".b", ".a"};

}  // namespace

std::string_view name(ValueType type) {
  switch (type) {
    case ValueType::number:
      return "number";
    case ValueType::vector:
      return "vector";
    case ValueType::colour:
      return "colour";
    case ValueType::mixture:
      return "mixture";
    case ValueType::label:
      break;
  }
  return "label";
}

Overlap overlap_called(std::string_view name) {
  const auto found = std::ranges::find(overlap_names, name);
  ASSERT(found != overlap_names.end());
  return static_cast<Overlap>(found - overlap_names.begin());
}

std::vector<std::string> parts_of(const AttributeDeclaration& declaration) {
  const std::string& name = declaration.name;
  std::vector<std::string> parts;
  switch (declaration.type) {
    case ValueType::number:
    case ValueType::label:
      return {name};
    case ValueType::vector:
      for (const std::string_view part : vector_parts) parts.push_back(name + std::string(part));
      break;
    case ValueType::colour:
      for (const std::string_view part : colour_parts) parts.push_back(name + std::string(part));
      break;
    case ValueType::mixture:
      for (const std::string& material : declaration.materials)
        parts.push_back(std::string(name).append(".").append(material));
      break;
  }
  return parts;
}

std::string_view attribute_of_part(std::string_view part) { return part.substr(0, part.find('.')); }

double default_of(const AttributeDeclaration& declaration, std::string_view part) {
  if (declaration.type == ValueType::number) return declaration.default_value;
  if (declaration.type == ValueType::mixture || declaration.type == ValueType::label) return 0;
  const std::vector<std::string> parts = parts_of(declaration);
  const auto found = std::ranges::find(parts, part);
  return found == parts.end() ? 0 : declaration.default_numbers[static_cast<size_t>(found - parts.begin())];
}

std::span<const StandardAttribute> standard_attributes() { return table; }

const StandardAttribute* standard_attribute(std::string_view name) {
  const auto* found = std::ranges::find(table, name, &StandardAttribute::name);
  return found == std::end(table) ? nullptr : found;
}

std::vector<AttributeDeclaration> attributes_below(std::span<const NodePtr> solids) {
  std::vector<AttributeDeclaration> known;
  for (const Node* node : topological({solids.begin(), solids.end()})) {
    const auto declared = node->declares();
    if (declared && std::ranges::find(known, declared->name, &AttributeDeclaration::name) == known.end())
      known.push_back(*declared);
  }
  return known;
}

std::vector<std::string> names_of_attributes(std::span<const NodePtr> solids) {
  std::vector<std::string> names;
  for (const AttributeDeclaration& declaration : attributes_below(solids))
    for (const std::string& part : parts_of(declaration)) names.push_back(to_lower(part));
  return names;
}

bool gives_attribute(std::span<const NodePtr> solids, std::string_view lower_case) {
  const std::vector<std::string> names = names_of_attributes(solids);
  return std::ranges::find(names, lower_case) != names.end();
}

}  // namespace ombre::design
