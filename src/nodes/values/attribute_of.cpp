// Compositions and attributes of solids as values.
#include <algorithm>

#include "base/text/text.h"
#include "design/attributes.h"
#include "design/spec.h"
#include "nodes/common/field_math.h"

namespace ombre::nodes {
namespace {

using namespace design;

constexpr MaterialId no_material = 0;

// Void comes first among materials.
void add_void(Composition& made, Field share) {
  if (!made.fractions.empty() && made.fractions.front().first == no_material)
    made.fractions.front().second = made.fractions.front().second + share;
  else
    made.fractions.insert(made.fractions.begin(), {no_material, share});
}

struct AttributeOf {
  SolidName solid;
  std::string name;
  AttributeDeclaration declared;                           // set when the node is made
  std::vector<std::pair<MaterialId, std::string>> shares;  // materials of a mixture with the names of their numbers

  static Spec<AttributeOf> spec() {
    return {"attribute_of",
            "An attribute of a solid at the point where the value is used; outside the solid, the attribute's default.",
            {{"solid", &AttributeOf::solid, "The solid that has the attribute", required()},
             {"name", &AttributeOf::name, "Name of the attribute, or of one of its numbers such as \"fibre.x\"",
              required()}},
            no_inputs,
            "cube(9, mix(\"red\", \"blue\", attribute_of(attribute(\"hardness\", \"x/9 + 0.5\", cube(9)), "
            "\"hardness\")));",
            {{"value", &AttributeOf::value, "Value of a number attribute; for a label, its number"},
             {"vector", &AttributeOf::vector, "Numbers of a vector (x, y, z) or colour (red, green, blue)"},
             {"alpha", &AttributeOf::alpha, "Opacity of a colour"},
             {"mixture", &AttributeOf::mixture, "Value of a mixture attribute; void outside the solid"}}};
  }

  bool complete(const Reader& reader) {
    const NodePtr not_held(NodePtr(), solid.node);
    const std::vector<AttributeDeclaration> all = attributes_below(std::span(&not_held, 1));
    std::vector<std::string> known;
    for (const AttributeDeclaration& one : all) {
      known.push_back(one.name);
      for (std::string& part : parts_of(one))
        if (part != one.name) known.push_back(std::move(part));
    }
    if (std::ranges::find(known, name) == known.end()) return fail(known, reader);
    declared = *std::ranges::find(all, attribute_of_part(name), &AttributeDeclaration::name);
    if (is(ValueType::mixture))
      for (const std::string& material : declared.materials)
        shares.emplace_back(reader.materials.find(material)->id, name + "." + material);
    std::ranges::sort(shares);
    return true;
  }

  bool gives(size_t output) const {
    if (output == 1) return is(ValueType::vector) || is(ValueType::colour);
    if (output == 2) return is(ValueType::colour);
    if (output == 3) return is(ValueType::mixture);
    return name.find('.') != std::string::npos || is(ValueType::number) || is(ValueType::label);
  }

  Field value(const Ask& ask) const { return number(ask, name); }
  VectorField vector(const Ask& ask) const { return {part(ask, 0), part(ask, 1), part(ask, 2)}; }
  Field alpha(const Ask& ask) const { return part(ask, 3); }
  Composition mixture(const Ask& ask) const {
    Composition made;
    Field rest = ask.p.constant(1);
    for (const auto& [id, share] : shares) {
      made.fractions.emplace_back(id, number(ask, share));
      rest = rest - made.fractions.back().second;
    }
    add_void(made, rest);
    return made;
  }

 private:
  // True if the whole attribute is wanted and has this type.
  bool is(ValueType type) const { return declared.type == type && name == declared.name; }
  Field part(const Ask& ask, size_t n) const { return number(ask, parts_of(declared)[n]); }
  Field number(const Ask& ask, std::string_view which) const {
    return select(ask.in.inside_of(solid, ask.p), ask.in.attribute_of(solid, which, ask.p),
                  ask.p.constant(default_of(declared, which)));
  }

  bool fail(const std::vector<std::string>& known, const Reader& reader) const {
    std::string hint = did_you_mean(name, known);
    if (hint.empty()) hint = known.empty() ? "it has no attributes" : "it has " + join(known, ", ");
    reader.diagnostics.error(Code::unknown_attribute, reader.where, "the solid has no attribute \"" + name + '"', hint,
                             {{"attribute", name}});
    return false;
  }
};

struct CompositionOf {
  SolidName solid;
  std::string of;
  MaterialId wanted = no_material;  // set when the node is made

  static Spec<CompositionOf> spec() {
    return {"composition_of",
            "The composition of a solid at the point where the value is used; outside the solid, void.",
            {{"solid", &CompositionOf::solid, "The solid", required()},
             {"of", &CompositionOf::of, "Material whose share is wanted; none: the mixture of all"}},
            no_inputs,
            "cube(9, composition_of(fgrade([\"x/9 + 0.5\", \"0.5 - x/9\"], [\"red\", \"blue\"], cube(9))));",
            {{"mixture", &CompositionOf::mixture, "The mixture of its materials"},
             {"share", &CompositionOf::share, "Share of the material, from 0 to 1", Interval(0, 1)}}};
  }

  bool complete(const Reader& reader) {
    if (of.empty()) return true;
    if (const Material* material = reader.materials.find(of)) {
      wanted = material->id;
      return true;
    }
    const std::vector<std::string> names = reader.materials.names();
    std::string hint = did_you_mean(of, names);
    if (hint.empty()) hint = "there are " + join(names, ", ");
    reader.diagnostics.error(Code::unknown_material, reader.where, "there is no material \"" + of + '"', hint,
                             {{"material", of}, {"similar", closest_name(of, names).value_or("")}});
    return false;
  }

  bool gives(size_t output) const { return output == (of.empty() ? 0 : 1); }

  Composition mixture(const Ask& ask) const {
    const Field inside = ask.in.inside_of(solid, ask.p), zero = ask.p.constant(0);
    Composition made = ask.in.composition_of(solid, ask.p);
    for (auto& [id, fraction] : made.fractions) fraction = select(inside, fraction, zero);
    for (auto& [number, flag] : made.checks) flag = logical_and(inside, flag);
    add_void(made, select(inside, zero, ask.p.constant(1)));
    return made;
  }

  Field share(const Ask& ask) const {
    if (ask.in.are_ranges()) return anything(ask.p, {0, 1});
    const Composition made = ask.in.composition_of(solid, ask.p);
    for (const auto& [id, fraction] : made.fractions)
      if (id == wanted) return select(ask.in.inside_of(solid, ask.p), limited(fraction, 0, 1), ask.p.constant(0));
    return ask.p.constant(0);
  }
};

}  // namespace

void add_attribute_of(Registry& registry) { registry.add<AttributeOf, CompositionOf>("values"); }

}  // namespace ombre::nodes
