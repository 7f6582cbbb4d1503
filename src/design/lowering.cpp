#include "design/lowering.h"

#include <algorithm>

#include "base/assert.h"
#include "design/many_parts.h"
#include "design/registry.h"

namespace ombre::design {

// A sub-program under construction. Its outputs are added as callers ask for them.
struct LoweringContext::Body {
  program::Builder builder;
  Lowering lowering;
  std::shared_ptr<program::Program> program = std::make_shared<program::Program>();
  std::vector<std::pair<std::string, Field>> outputs;
  std::unordered_map<program::ValueId, uint32_t> numbers;

  Body(LoweringContext& context, const Node& node) : lowering(context, builder) { lowering.own_ = &node; }

  Point frame() { return Point::origin_frame(builder); }

  uint32_t number(const std::string& name, Field field) {
    const auto [it, is_new] = numbers.try_emplace(field.id, static_cast<uint32_t>(outputs.size()));
    if (is_new) {
      outputs.emplace_back(name, field);
      program->output_names.push_back(name);
    }
    return it->second;
  }

  // The field of an output where the body is called with p.
  Field call(const std::string& name, Field field, const Point& p) {
    if (const auto constant = builder.constant_value(field)) return p.constant(*constant);
    return p.builder().call(program, number(name, field), p.x, p.y, p.z);
  }

  Composition call(const LoweringContext& context, Composition own, const Point& p) {
    for (auto& [id, fraction] : own.fractions) fraction = call(context.materials().all()[id].name, fraction, p);
    for (auto& [check, mark] : own.checks) mark = call("check " + std::to_string(check), mark, p);
    return own;
  }
};

LoweringContext::LoweringContext(const MaterialTable& materials, const std::vector<NodePtr>& roots,
                                 std::optional<JobScale> scale, int threads)
    : materials_(materials), roots_(roots), scale_(scale), threads_(threads) {
  std::unordered_map<const Node*, int> uses;
  for (const Node* node : topological(roots)) {
    for (const NodePtr& input : node->dependencies())
      if (node->repetitions() > 1 || (input.use_count() > 1 && ++uses[input.get()] == 2)) shared_.insert(input.get());
    if (const auto declared = node->declares()) {
      bool known = false;
      for (const auto& attribute : attributes_) known = known || attribute.name == declared->name;
      if (!known) attributes_.push_back(*declared);
    }
  }
}

LoweringContext::~LoweringContext() = default;

std::optional<JobScale> LoweringContext::scale(const Node& node) {
  if (!scale_) return std::nullopt;
  const std::scoped_lock lock(asked_);
  if (scales_.empty()) find_scales();
  return scales_.at(&node) * *scale_;
}

void LoweringContext::tell(const Diagnostic& diagnostic) {
  const std::scoped_lock lock(asked_);
  diagnostics_.add_new(diagnostic);
}

void LoweringContext::find_scales() {
  for (const NodePtr& root : roots_) scales_.emplace(root.get(), 1);
  std::vector<const Node*> nodes = topological(roots_);
  std::reverse(nodes.begin(), nodes.end());
  for (const Node* node : nodes) {
    program::Builder builder;
    const auto inner = node->inner(Point::origin_frame(builder));
    const auto input_from_node = inner ? inner->from_inputs() : std::nullopt;
    const double shrinks = input_from_node ? stretch(*input_from_node).least : 1;
    const double own = scales_.at(node), of_inputs = own * (shrinks > 0 ? shrinks : 1);
    const auto set = [&](const NodePtr& other, double scale) {
      const auto [known, is_new] = scales_.emplace(other.get(), scale);
      if (!is_new) known->second = std::min(known->second, scale);
    };
    for (const NodePtr& input : node->inputs()) set(input, of_inputs);
    for (const NodePtr& value : node->values()) set(value, own);
  }
}

LoweringContext::Body& LoweringContext::body_of(const Node& node) {
  auto& slot = bodies_[&node];
  if (!slot) {
    slot = std::make_unique<Body>(*this, node);
    body_order_.push_back(slot.get());
  }
  return *slot;
}

uint32_t LoweringContext::register_check(const Node& node, const std::string& message) {
  const auto [it, is_new] = check_numbers_.try_emplace({&node, message}, static_cast<uint32_t>(checks_.size()));
  if (is_new) checks_.push_back({node.where(), message});
  return it->second;
}

void LoweringContext::finish_bodies() {
  for (Body* body : body_order_) *body->program = body->builder.finish(body->outputs);
}

size_t Lowering::KeyHash::operator()(const Key& key) const {
  size_t h = std::hash<const void*>()(key.node);
  const size_t question = static_cast<size_t>(key.query) + (size_t{key.output} << 8);
  for (const size_t part : {size_t{key.x}, size_t{key.y}, size_t{key.z}, question})
    h = (h ^ part) * 0x9E3779B97F4A7C15ull + (h >> 29);
  return h;
}

Lowering::Key Lowering::key_of(const Node& node, const Point& p, Query query) {
  return {&node, p.x.id, p.y.id, p.z.id, query};
}

LoweringContext::Body* Lowering::body_for(const Node& node) {
  if (node.uses_cell()) return nullptr;  // bodies know no cell
  return &node != own_ && !stands_alone_ && context_.is_shared(node) ? &context_.body_of(node) : nullptr;
}

Field Lowering::once(const Node& node, const Point& p, Query query,
                     Field (Lowering::*make)(const Node&, const Point&)) {
  const Key key = key_of(node, p, query);
  if (const auto known = fields_.find(key); known != fields_.end()) return known->second;
  const Field field = (this->*make)(node, p);
  fields_.emplace(key, field);
  return field;
}

Field Lowering::distance(const Node& node, const Point& p) {
  if (auto* body = body_for(node)) return body->call("distance", body->lowering.distance(node, body->frame()), p);
  return once(node, p, Query::distance, &Lowering::make_distance);
}

Field Lowering::inside(const Node& node, const Point& p) {
  if (auto* body = body_for(node)) return body->call("inside", body->lowering.inside(node, body->frame()), p);
  return once(node, p, Query::inside, &Lowering::make_inside);
}

Field Lowering::interior(const Node& node, const Point& p) {
  if (auto* body = body_for(node)) return body->call("interior", body->lowering.interior(node, body->frame()), p);
  return once(node, p, Query::interior, &Lowering::make_interior);
}

Field Lowering::number(const NodeOutput& output, const Point& p) {
  return numbers(*output.node, output.output, p)[std::max(output.axis, 0)];
}

VectorField Lowering::numbers(const Node& node, size_t output, const Point& p) {
  if (auto* body = body_for(node)) {
    const std::string& name = node.type().outputs[output].name;
    VectorField own = body->lowering.numbers(node, output, body->frame());
    for (Field* field : {&own.x, &own.y, &own.z})
      if (*field) *field = body->call(name, *field, p);
    return own;
  }
  Key key = key_of(node, p, Query::numbers);
  key.output = static_cast<uint32_t>(output);
  if (const auto known = numbers_.find(key); known != numbers_.end()) return known->second;
  const Inputs in(node, this);
  const VectorField made = node.numbers(output, {in, p});
  numbers_.emplace(key, made);
  return made;
}

Composition Lowering::mixture(const Node& node, const Point& p) {
  if (auto* body = body_for(node)) return body->call(context_, body->lowering.mixture(node, body->frame()), p);
  const Key key = key_of(node, p, Query::mixture);
  if (const auto known = compositions_.find(key); known != compositions_.end()) return known->second;
  const Inputs in(node, this);
  Composition made = node.mixture({in, p});
  compositions_.emplace(key, made);
  return made;
}

Field Lowering::make_distance(const Node& node, const Point& p) { return node.distance(Inputs(node, this), p); }

Field Lowering::make_inside(const Node& node, const Point& p) {
  if (const auto own = node.inside(Inputs(node, this), p)) return *own;
  if (const auto inner = node.inner(p)) return inside(*node.inputs()[0], *inner);
  return distance(node, p) <= 0;
}

Field Lowering::make_interior(const Node& node, const Point& p) {
  if (const auto own = node.interior(Inputs(node, this), p)) return *own;
  if (const auto inner = node.inner(p)) return interior(*node.inputs()[0], *inner);
  return distance(node, p) < 0;
}

Field Lowering::along(const Node& node, const Point& p) {
  if (auto* body = body_for(node)) return body->call("t", body->lowering.along(node, body->frame()), p);
  if (const auto own = node.along(Inputs(node, this), p)) return *own;
  if (const auto inner = node.inner(p)) return along(*node.inputs()[0], *inner);
  // Of several, the first that is made of struts and holds the point.
  Field result;
  for (size_t i = node.inputs().size(); i-- > 0;) {
    const Node& input = *node.inputs()[i];
    if (!input.has_along()) continue;
    result = result ? select(inside(input, p), along(input, p), result) : along(input, p);
  }
  return result ? result : p.constant(0);
}

Composition Lowering::composition(const Node& node, const Point& p, Demand demand) {
  if (auto* body = body_for(node))
    return body->call(context_, body->lowering.composition(node, body->frame(), demand), p);
  const Key key = key_of(node, p, demand == Demand::inside ? Query::composition_inside : Query::composition_everywhere);
  if (const auto known = compositions_.find(key); known != compositions_.end()) return known->second;
  Composition made = make_composition(node, p, demand);
  compositions_.emplace(key, made);
  return made;
}

Composition Lowering::make_composition(const Node& node, const Point& p, Demand demand) {
  if (auto own = node.composition(Inputs(node, this), p, demand)) return std::move(*own);
  if (const auto inner = node.inner(p)) return composition(*node.inputs()[0], *inner, demand);
  if (!node.inputs().empty()) return composition(*node.inputs()[0], p, demand);
  return Composition::pure(context_.materials().first().id, p.constant(1));
}

Field Lowering::attribute(const Node& node, std::string_view name, const Point& p, Demand demand) {
  if (auto* body = body_for(node))
    return body->call(std::string(name), body->lowering.attribute(node, name, body->frame(), demand), p);
  return make_attribute(node, name, p, demand);
}

Field Lowering::make_attribute(const Node& node, std::string_view name, const Point& p, Demand demand) {
  if (!has_attribute(node, name)) {
    const AttributeDeclaration* declared = declaration(name);
    return p.constant(declared ? declared->default_value : 0);
  }
  if (const auto own = node.attribute(Inputs(node, this), name, p, demand)) return *own;
  if (const auto inner = node.inner(p)) return attribute(*node.inputs()[0], name, *inner, demand);
  return attribute(*node.inputs()[0], name, p, demand);
}

bool Lowering::has_attribute(const Node& node, std::string_view name) { return context_.carries(node, name); }

bool LoweringContext::carries(const Node& node, std::string_view attribute) {
  const auto declared = node.declares();
  if (declared && declared->name == attribute) return true;
  const auto some_input = [&] {
    return std::ranges::any_of(node.inputs(), [&](const NodePtr& input) { return carries(*input, attribute); });
  };
  if (!is_shared(node)) return some_input();
  // Asked once, since there may be very many ways to it.
  const std::pair key(&node, std::string(attribute));
  const auto known = [&]() -> std::optional<bool> {
    const std::scoped_lock lock(asked_);
    const auto found = carries_.find(key);
    return found != carries_.end() ? std::optional(found->second) : std::nullopt;
  };
  if (const auto answer = known()) return *answer;
  const bool answer = some_input();
  const std::scoped_lock lock(asked_);
  carries_.emplace(key, answer);
  return answer;
}

const AttributeDeclaration* Lowering::declaration(std::string_view name) const {
  for (const auto& attribute : context_.attributes_)
    if (attribute.name == name) return &attribute;
  return nullptr;
}

MaterialId Lowering::material(const MaterialName& name) const {
  ASSERT(name.material && name.material == context_.materials().find(name.material->id) &&
         "parameters hold materials of the table");
  return name.material->id;
}

uint32_t Lowering::add_check(const Node& node, const std::string& message) {
  if (!stands_alone_) return context_.register_check(node, message);
  for (size_t n = 0; n < local_checks_.size(); ++n)
    if (local_checks_[n].node == &node && local_checks_[n].message == message) return static_cast<uint32_t>(n);
  local_checks_.push_back({&node, message});
  return static_cast<uint32_t>(local_checks_.size() - 1);
}

std::optional<PartFields> Lowering::many_parts(const Node& node, const PartList& list, PartQuery query, const Point& p,
                                               const Falloff* falloff) {
  if (stands_alone_) return std::nullopt;  // tables do not hold tables
  // The parts take the frame in, so that they are asked at the program's own inputs.
  const auto map = p.from_inputs();
  const ManyParts* parts = context_.many_parts(node, list, query, map.value_or(Affine{}), falloff);
  if (!parts) return std::nullopt;
  return parts->at(map ? Point::origin_frame(builder_) : p);
}

}  // namespace ombre::design
