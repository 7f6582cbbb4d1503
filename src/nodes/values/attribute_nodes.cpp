// Named values that solids have besides their material.
#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "design/attributes.h"
#include "design/lowering.h"
#include "design/spec.h"
#include "nodes/common/child_distance.h"

namespace ombre::nodes {
namespace {

using namespace design;

ValueType type_called(const Choice& type) {
  return type == "vector"    ? ValueType::vector
         : type == "colour"  ? ValueType::colour
         : type == "mixture" ? ValueType::mixture
                             : ValueType::number;
}

std::string with_article(ValueType type) { return "a " + std::string(name(type)); }

std::string range_text(const StandardAttribute& standard) {
  const std::string unit = standard.unit == "1" ? "" : " " + std::string(standard.unit);
  if (standard.range.is_bounded())
    return "from " + format_number(standard.range.lo) + " to " + format_number(standard.range.hi) + unit;
  return "at least " + format_number(standard.range.lo) + unit;
}

struct Attribute {
  std::string name;
  AttributeValue value;
  std::string unit_text;
  std::optional<double> default_value;
  Choice overlap = "first";
  Choice type = "auto";
  std::vector<std::pair<std::string, MaterialId>> held;  // materials of a mixture, set when the node is made

  static Spec<Attribute> spec() {
    return {
        "attribute",
        "Gives its child a named value, constant or by a formula: a number such as a density, a vector, a colour "
        "or a mixture of materials.",
        {{"name", &Attribute::name, "Its name; standard names such as modulus have a unit and a range", required()},
         {"value", &Attribute::value,
          "A number or an expression; three of them for a vector, four or \"#rrggbb\" for a colour; a material or a "
          "value for a mixture. In expressions d is the signed distance of the child and t the position along its "
          "struts; its attributes are available by name",
          required(over_child())},
         {"unit", &Attribute::unit_text, "Its unit, as information for users of the value; standard names have one"},
         {"default", &Attribute::default_value, "Its value where no solid sets it"},
         {"overlap", &Attribute::overlap,
          "Rule that combines values where solids overlap, number by number; mix weights them in blends",
          one_of({overlap_names.begin(), overlap_names.end()})},
         {"type", &Attribute::type, "Its type; auto: that of the value, or of the standard name",
          one_of({"auto", "number", "vector", "colour", "mixture"})}},
        one_solid,
        "attribute(\"modulus\", \"1000 + 100*z\") { cube(10); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    const StandardAttribute* standard = standard_attribute(name);
    if (!check_name(reader) || !check_child_variables(reader, *inputs[0], value.used())) return false;
    if (!become_wanted(standard, reader)) return false;
    take_standard(standard, inputs[0]->bounds(design_space()), reader);
    find_materials(reader);
    return true;
  }

  AttributeDeclaration declares() const {
    AttributeDeclaration declared{name, unit_text, default_value.value_or(0), overlap_called(overlap.text())};
    declared.type = value.type;
    declared.default_numbers.fill(declared.default_value);
    for (const auto& [material, id] : held) declared.materials.push_back(material);
    if (const StandardAttribute* standard = standard_attribute(name)) declared.range = standard->range;
    return declared;
  }

  // Other attributes come from the child.
  Field attribute(const Inputs& in, std::string_view wanted, const Point& p, Demand demand) const {
    if (attribute_of_part(wanted) != name) return in.attribute(0, wanted, p, demand);
    if (value.type == ValueType::mixture) return fraction(in, wanted, p);
    const std::vector<std::string> parts = parts_of(declares());
    const auto part = static_cast<size_t>(std::ranges::find(parts, wanted) - parts.begin());
    return part < parts.size() ? value.numbers[part].at(p, child_variables(in, p)) : p.constant(0);
  }

 private:
  bool check_name(const Reader& reader) const {
    if (name.empty()) return reader.refuse("an attribute needs a name");
    if (fold_name(name) == "material" || fold_name(name) == "volumefractions")
      return reader.refuse("the attribute \"" + name + "\" is set by fgrade or material");
    if (name.find('.') != std::string::npos)
      return reader.refuse("the name of the attribute \"" + name + "\" has a dot",
                           "dots stand before the parts of vectors, colours and mixtures: write _ instead");
    return true;
  }

  // Converts the value to the type of `type` or of the standard name, if the conversion is unambiguous.
  bool become_wanted(const StandardAttribute* standard, const Reader& reader) {
    if (standard && type != "auto" && type_called(type) != standard->type)
      return fail_type("the attribute \"" + name + "\" is " + with_article(standard->type) + ", not " +
                           with_article(type_called(type)),
                       reader);
    const ValueType wanted = standard ? standard->type : type == "auto" ? value.type : type_called(type);
    if (wanted == value.type) return true;
    if (wanted == ValueType::colour && value.type == ValueType::mixture && value.mixture.material) {
      for (size_t n = 0; n < 4; ++n) value.numbers[n] = value.mixture.material->colour[n] / 255.0;
    } else if (wanted == ValueType::colour && value.type == ValueType::vector) {
      value.numbers[3] = 1;
    } else if (!(wanted == ValueType::vector && value.type == ValueType::colour && standard)) {
      return fail_type("the attribute \"" + name + "\" is " + with_article(wanted) + ", and its value is " +
                           with_article(value.type),
                       reader);
    }
    value.type = wanted;
    return true;
  }

  bool fail_type(const std::string& message, const Reader& reader) const {
    return reader.refuse(message,
                         "numbers are written as 3 or \"x/10\", vectors as [1, 0, 0], colours as [1, 0.5, 0, 1] or "
                         "\"#ff8000\", mixtures as " +
                             spelled::either("mix(red, blue, t)", R"({"from": "n3", "output": "mixture"})",
                                             R"(ombre.mix("red", "blue", t))"));
  }

  // Takes the unit, range and default of a standard attribute. A different unit is kept with a warning, since older
  // designs have some; then the range is unknown.
  void take_standard(const StandardAttribute* standard, const Box& where, const Reader& reader) {
    if (!default_value) default_value = standard ? standard->default_value : 0;
    if (!standard) return;
    if (unit_text.empty()) unit_text = standard->unit;
    if (unit_text != standard->unit) {
      reader.diagnostics.warning(reader.where,
                                 "the attribute \"" + name + "\" has the unit " + std::string(standard->unit) +
                                     " as a standard name, and " + unit_text + " here",
                                 "convert its value and leave out the unit, or give it a name of your own");
      return;
    }
    for (const Number& number : value.used()) {
      const double* constant = number.constant();
      const Interval found = constant           ? Interval(*constant)
                             : where.is_empty() ? Interval::everything()
                                                : number.range(where);
      if (found.hi >= standard->range.lo && found.lo <= standard->range.hi) continue;
      const std::string text =
          constant ? format_number(*constant) : format_rounded(found.lo, 4) + " to " + format_rounded(found.hi, 4);
      reader.diagnostics.warning(reader.where,
                                 "the attribute \"" + name + "\" is " + range_text(*standard) + ", found " + text,
                                 "give it a name of your own if you mean something else");
    }
  }

  void find_materials(const Reader& reader) {
    held.clear();
    if (value.type != ValueType::mixture) return;
    for (const MaterialId id : materials_of(value.mixture, reader.materials))
      held.emplace_back(reader.materials.all()[id].name, id);
  }

  // Returns the fraction of the material that the part names.
  Field fraction(const Inputs& in, std::string_view part, const Point& p) const {
    const std::string_view material = part.substr(std::min(part.size(), name.size() + 1));
    for (const auto& [id, share] : in.composition_of(value.mixture, p).fractions)
      for (const auto& [held_name, held_id] : held)
        if (held_id == id && held_name == material) return share;
    return p.constant(0);
  }
};

}  // namespace

void add_attributes(Registry& registry) { registry.add<Attribute>("attributes"); }

}  // namespace ombre::nodes
