#include "design/node.h"

#include <algorithm>
#include <unordered_set>

#include "base/assert.h"
#include "base/text.h"
#include "design/lowering.h"
#include "design/registry.h"

namespace ombre::design {

void Node::finish(std::vector<NodePtr> inputs, const std::vector<NodePtr>& values, SourceRange where) {
  where_ = std::move(where);
  input_count_ = static_cast<uint32_t>(inputs.size());
  value_count_ = static_cast<uint16_t>(values.size());
  if (input_count_ + value_count_ > 0) inputs_ = std::make_unique<NodePtr[]>(size_t{input_count_} + value_count_);
  std::copy(values.begin(), values.end(), std::move(inputs.begin(), inputs.end(), inputs_.get()));
  int depth = 1;
  for (const NodePtr& other : dependencies()) depth = std::max(depth, other->depth() + 1);
  depth_ = static_cast<uint16_t>(depth) & 0xFFF;
  uses_cell_ = !traits().gives_cell &&
               (has_cell_numbers() ||
                std::ranges::any_of(dependencies(), [](const NodePtr& other) { return other->uses_cell(); }));
  const Metric metric = find_metric(Inputs(*this, nullptr));
  lipschitz_ = metric.lipschitz;
  kind_ = static_cast<uint16_t>(metric.kind) & 7;
}

Traits Node::traits_of_shape() const {
  const Node* node = this;
  while (node->keeps_shape()) node = node->inputs().front().get();
  return node->traits();
}

bool Node::has_along() const {
  if (inputs().empty()) return gives_along();
  return std::ranges::any_of(inputs(), [](const NodePtr& input) { return input->has_along(); });
}

bool Node::is_nothing() const { return type().is_nothing; }

size_t Node::first_output() const {
  size_t output = 0;
  while (!gives(output)) ++output;
  return output;
}

Box BoundsMemory::of(const Node& node, const Box& where, double margin) {
  // What is only a few nodes in a row is evaluated again: remembering it would cost more.
  constexpr int few = 4;
  if (node.depth() <= few && node.inputs().size() <= 1) return node.reach(Inputs(node, nullptr, this), where, margin);
  const auto known = last_.find(&node);
  if (known != last_.end() && known->second.where == where && known->second.margin == margin) return known->second.box;
  const Box box = node.reach(Inputs(node, nullptr, this), where, margin);
  last_[&node] = {where, margin, box};
  return box;
}

Box Node::bounds(const Box& where) const {
  BoundsMemory memory;
  return memory.of(*this, where, 0);
}

Node::~Node() {
  std::vector<NodePtr> open;
  const auto take_inputs = [&open](Node& node) {
    for (uint32_t i = 0; i < node.input_count_ + node.value_count_; ++i) open.push_back(std::move(node.inputs_[i]));
  };
  take_inputs(*this);
  while (!open.empty()) {
    const NodePtr node = std::move(open.back());
    open.pop_back();
    if (node.use_count() == 1) take_inputs(const_cast<Node&>(*node));
  }
}

std::vector<const Node*> topological(const std::vector<NodePtr>& roots) {
  std::vector<const Node*> order;
  std::unordered_set<const Node*> seen;
  // What only one node holds cannot be seen twice.
  const auto is_new = [&](const NodePtr& node) { return node.use_count() == 1 || seen.insert(node.get()).second; };
  struct Visit {
    const Node* node;
    size_t next;
  };
  std::vector<Visit> stack;
  for (const NodePtr& root : roots) {
    if (is_new(root)) stack.push_back({root.get(), 0});
    while (!stack.empty()) {
      Visit& visit = stack.back();
      if (visit.next == visit.node->dependencies().size()) {
        order.push_back(visit.node);
        stack.pop_back();
        continue;
      }
      const NodePtr& next = visit.node->dependencies()[visit.next++];
      if (is_new(next)) stack.push_back({next.get(), 0});
    }
  }
  return order;
}

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
  return lowering_ ? lowering_->distance(*solid.node, p) : anything(p);
}

Field Inputs::inside_of(const SolidName& solid, const Point& p) const {
  return lowering_ ? lowering_->inside(*solid.node, p) : anything(p, {0, 1});
}

Composition Inputs::composition_of(const SolidName& solid, const Point& p) const {
  return lowering_->composition(*solid.node, p, Demand::everywhere);
}

Field Inputs::attribute_of(const SolidName& solid, std::string_view attribute_name, const Point& p) const {
  return lowering_ ? lowering_->attribute(*solid.node, attribute_name, p, Demand::inside) : anything(p);
}

Field Inputs::along(size_t i, const Point& p) const { return lowering_->along(input(i), p); }

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
  Field along(const Inputs& in, size_t i, const Point& p) const override { return in.along(i, p); }
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
  return name.mixture ? lowering_->mixture(*name.mixture, p) : Composition::pure(material(name), p.constant(1));
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
