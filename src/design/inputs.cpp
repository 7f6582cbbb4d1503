// Access of nodes to their inputs, implemented by the lowering.
#include "base/text/text.h"
#include "design/lowering.h"
#include "design/node.h"
#include "design/registry.h"

namespace ombre::design {

size_t Inputs::count() const { return node_.inputs().size(); }
const Node& Inputs::input(size_t i) const { return *node_.inputs()[i]; }
Box Inputs::reach(size_t i, const Box& where, double margin) const { return memory_->of(input(i), where, margin); }
Metric Inputs::metric(size_t i) const { return input(i).metric(); }
Field Inputs::distance(size_t i, const Point& p) const { return lowering_->distance(input(i), p); }
Field Inputs::membership(size_t i, const Point& p, Border border) const {
  return lowering_->membership(input(i), p, border);
}
Composition Inputs::composition(size_t i, const Point& p, Demand demand) const {
  return lowering_->composition(input(i), p, demand);
}
Field Inputs::attribute(size_t i, std::string_view attribute_name, const Point& p, Demand demand) const {
  return lowering_->attribute(input(i), attribute_name, p, demand);
}
bool Inputs::has_attribute(size_t i, std::string_view attribute_name) const {
  return lowering_->has_attribute(input(i), attribute_name);
}
AttributeDeclaration Inputs::declaration(std::string_view attribute_name) const {
  const AttributeDeclaration* found = lowering_->declaration(attribute_name);
  return found ? *found : AttributeDeclaration{std::string(attribute_name), "", 0, Overlap::first};
}

std::string Inputs::attribute_called(size_t i, std::string_view lower_case) const {
  for (const AttributeDeclaration& declaration : lowering_->attributes()) {
    if (!has_attribute(i, declaration.name)) continue;
    for (const std::string& part : parts_of(declaration))
      if (to_lower(part) == lower_case) return part;
  }
  return "";
}

Field Inputs::distance_to(const SolidName& solid, const Point& p) const {
  if (!lowering_) return anything(p);
  if (solid.node->type().is_solid()) return lowering_->distance(*solid.node, p);
  return lowering_->answer(*solid.node, solid.output, p).numbers[0];
}

Field Inputs::inside_of(const SolidName& solid, const Point& p) const {
  if (!lowering_) return anything(p, {0, 1});
  if (solid.node->type().is_solid()) return lowering_->inside(*solid.node, p);
  // A region may give its membership besides its g.
  const Field known = lowering_->answer(*solid.node, solid.output, p).numbers[1];
  return known ? known : at_most(distance_to(solid, p), 0, Border::included);
}

Composition Inputs::composition_of(const SolidName& solid, const Point& p) const {
  if (solid.node->type().is_solid()) return lowering_->composition(*solid.node, p, Demand::everywhere);
  const OutputAnswer answer = lowering_->answer(*solid.node, solid.output, p);
  return answer.composition ? *answer.composition : lowering_->default_composition(p);
}

Field Inputs::attribute_of(const SolidName& solid, std::string_view attribute_name, const Point& p) const {
  return lowering_ ? lowering_->attribute(*solid.node, attribute_name, p, Demand::inside) : anything(p);
}

Numbers4 Inputs::output_of(const SolidName& solid, std::string_view output_name, const Point& p) const {
  if (!lowering_) return {anything(p), anything(p), anything(p), anything(p)};
  return lowering_->output(*solid.node, output_name, p);
}

Numbers4 Inputs::output(size_t i, std::string_view output_name, const Point& p) const {
  return lowering_->output(input(i), output_name, p);
}

namespace {

class InputList : public PartList {
 public:
  explicit InputList(const Node& node) : node_(node) {}

  size_t count() const override { return node_.inputs().size(); }
  Box reach(size_t i, const Box& where, double margin) const override {
    BoundsMemory memory;
    return memory.of(*node_.inputs()[i], where, margin);
  }
  bool uses_cell(size_t i) const override { return node_.inputs()[i]->uses_cell(); }
  Field distance(const Inputs& in, size_t i, const Point& p) const override { return in.distance(i, p); }
  Field membership(const Inputs& in, size_t i, const Point& p, Border border) const override {
    return in.membership(i, p, border);
  }
  Field along(const Inputs& in, size_t i, const Point& p) const override { return in.output(i, along_output, p)[0]; }
  Composition composition(const Inputs& in, size_t i, const Point& p, Demand demand) const override {
    return in.composition(i, p, demand);
  }

 private:
  const Node& node_;
};

}  // namespace

std::optional<PartFields> Inputs::many_parts(PartQuery query, const Point& p, const Falloff* falloff) const {
  return lowering_->many_parts(node_, InputList(node_), query, p, falloff);
}

std::optional<PartFields> Inputs::many_parts(PartQuery query, const Point& p, const PartList& list) const {
  return lowering_->many_parts(node_, list, query, p, nullptr);
}

std::vector<Field> Inputs::distances(const Point& p) const {
  std::vector<Field> fields;
  for (size_t i = 0; i < count(); ++i) fields.push_back(distance(i, p));
  return fields;
}
std::vector<Field> Inputs::memberships(const Point& p, Border border) const {
  std::vector<Field> fields;
  for (size_t i = 0; i < count(); ++i) fields.push_back(membership(i, p, border));
  return fields;
}

MaterialId Inputs::material(const MaterialName& material_name) const { return lowering_->material(material_name); }

Composition Inputs::composition_of(const MaterialName& name, const Point& p) const {
  if (!name.mixture.node) return Composition::pure(material(name), p.constant(1));
  return *lowering_->answer(*name.mixture.node, name.mixture.output, p).composition;
}

std::optional<JobScale> Inputs::scale() const { return lowering_->scale(node_); }

program::SourceField Inputs::staged(const StagePtr& stage) const { return lowering_->staged(node_, stage); }

void Inputs::report(Severity severity, const std::string& message, const Phrase& hint) const {
  lowering_->report({severity, node_.where(), message, hint});
}

std::pair<uint32_t, Field> Inputs::check(Field bad, const std::string& message) const {
  return {lowering_->add_check(node_, message), bad};
}

}  // namespace ombre::design
