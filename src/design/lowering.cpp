#include "design/lowering.h"

#include <algorithm>
#include <cmath>

#include "base/system/assert.h"
#include "design/many_parts.h"
#include "design/registry.h"

namespace ombre::design {

namespace {

// Replaces a stage if there is no job. All its channels are 0, and the distance to its flagged cells is as large as
// possible.
class EmptyStage final : public program::FieldSource {
 public:
  explicit EmptyStage(const Stage& stage) : name_(stage.name()), content_(stage.content()) {}
  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::empty(); }
  int channel(std::string_view channel_name) const override {
    return channel_name == "distance" ? distance_channel : value_channel;
  }
  double sample(int channel, Vec3) const override { return channel == distance_channel ? design_limit_mm : 0; }
  Interval range(int channel, const Box&) const override { return Interval(sample(channel, {})); }

 private:
  static constexpr int value_channel = 0, distance_channel = 1;

  std::string name_;
  Hash content_;
};

Vec3 voxel_mm(const StageLattice& lattice) {
  return {lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()};
}

bool is_shift(const Affine& map) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(map.rows[axis] == Affine{}.rows[axis])) return false;
  return true;
}

bool are_whole_voxels(Vec3 offset, const StageLattice& lattice) {
  constexpr double slack = 1e-6;
  const Vec3 size = voxel_mm(lattice);
  for (int axis = 0; axis < 3; ++axis) {
    const double voxels = offset[axis] / size[axis];
    if (!(std::abs(voxels - std::round(voxels)) <= slack)) return false;
  }
  return true;
}

}  // namespace

// A sub-program under construction. Outputs are added when callers need them.
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

  // Returns the field of an output when the body is called at p.
  Field call(const std::string& name, Field field, const Point& p) {
    if (const auto constant = builder.constant_value(field)) return p.constant(*constant);
    return p.builder().call(program, number(name, field), p.x, p.y, p.z);
  }

  Composition call(const LoweringContext& context, Composition own, const Point& p) {
    for (auto& [id, fraction] : own.fractions) fraction = call(context.materials().all()[id].name, fraction, p);
    for (auto& [check, flag] : own.checks) flag = call("check " + std::to_string(check), flag, p);
    return own;
  }
};

LoweringContext::LoweringContext(const MaterialTable& materials, const std::vector<NodePtr>& roots,
                                 std::optional<JobScale> scale, int threads)
    : materials_(materials), roots_(roots), scale_(scale), threads_(threads) {
  std::unordered_map<const Node*, int> uses;
  for (const Node* node : topological(roots)) {
    for (const NodePtr& input : node->dependencies())
      if (node->traits().most_evaluations_of_input > 1 || (input.use_count() > 1 && ++uses[input.get()] == 2))
        shared_.insert(input.get());
    if (const auto declared = node->declares()) declare(*declared);
  }
}

LoweringContext::~LoweringContext() = default;

// Adds a declaration. The first node that sets an attribute determines it; a mixture gets the materials of all nodes, a
// label their names.
void LoweringContext::declare(const AttributeDeclaration& declared) {
  const auto known = std::ranges::find(attributes_, declared.name, &AttributeDeclaration::name);
  if (known == attributes_.end()) return attributes_.push_back(declared);
  for (const Material& material : materials_.all()) {
    const bool is_held = std::ranges::find(known->materials, material.name) != known->materials.end();
    if (!is_held && std::ranges::find(declared.materials, material.name) != declared.materials.end())
      known->materials.push_back(material.name);
  }
  for (const std::string& label : declared.labels)
    if (std::ranges::find(known->labels, label) == known->labels.end()) known->labels.push_back(label);
}

void LoweringContext::use_stages(const std::optional<StageLattice>& lattice, std::shared_ptr<StageHost> host) {
  lattice_ = lattice;
  stages_ = std::move(host);
}

std::optional<JobScale> LoweringContext::scale(const Node& node) {
  if (!scale_) return std::nullopt;
  return view(node).scale * *scale_;
}

program::SourceField LoweringContext::staged(const Node& node, const StagePtr& stage) {
  if (!stages_) return std::make_shared<EmptyStage>(*stage);
  const View here = view(node);
  StagePlace place{materials_, std::nullopt, std::nullopt, std::nullopt};
  if (scale_) place.scale = here.scale * *scale_;
  if (place.scale) place.voxel_mm = place.scale->voxel_mm;
  if (lattice_) place.voxel_mm = here.scale * voxel_mm(*lattice_);
  if (lattice_ && here.offset) place.lattice = StageLattice{lattice_->origin + *here.offset, lattice_->pitch};
  return stages_->source(stage, place);
}

void LoweringContext::report(const Diagnostic& diagnostic) {
  const std::scoped_lock lock(queries_mutex_);
  diagnostics_.add_new(diagnostic);
}

LoweringContext::View LoweringContext::view(const Node& node) {
  const std::scoped_lock lock(queries_mutex_);
  if (views_.empty()) find_views();
  return views_.at(&node);
}

void LoweringContext::find_views() {
  for (const NodePtr& root : roots_) views_.emplace(root.get(), View{1, Vec3{}});
  std::vector<const Node*> nodes = topological(roots_);
  std::reverse(nodes.begin(), nodes.end());
  for (const Node* node : nodes) {
    program::Builder builder;
    const auto inner = node->inner(Point::origin_frame(builder));
    const auto input_from_node = inner ? inner->from_inputs() : std::nullopt;
    const double shrinks = input_from_node ? stretch(*input_from_node).least : 1;
    const View own = views_.at(node);
    View below = own;
    below.scale *= shrinks > 0 ? shrinks : 1;
    if (node->traits().most_evaluations_of_input > 1 || (inner && !(input_from_node && is_shift(*input_from_node))))
      below.offset = std::nullopt;
    else if (inner && below.offset)
      below.offset = *below.offset + input_from_node->offset;
    const auto set = [&](const NodePtr& other, const View& view) {
      const auto [known, is_new] = views_.emplace(other.get(), view);
      if (!is_new) meet(known->second, view);
    };
    for (const NodePtr& input : node->inputs()) set(input, below);
    View beside = own;
    if (node->traits().most_evaluations_of_input > 1) beside.offset = std::nullopt;
    for (const NodePtr& value : node->values()) set(value, beside);
  }
}

void LoweringContext::meet(View& known, const View& other) const {
  known.scale = std::min(known.scale, other.scale);
  if (!known.offset) return;
  if (!lattice_ || !other.offset || !are_whole_voxels(*other.offset - *known.offset, *lattice_))
    known.offset = std::nullopt;
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
  if (node.uses_cell()) return nullptr;  // bodies do not know the cell
  return &node != own_ && !stands_alone_ && context_.is_shared(node) ? &context_.body_of(node) : nullptr;
}

template <class Make>
Field Lowering::once(const Node& node, const Point& p, Query query, const Make& make) {
  const Key key = key_of(node, p, query);
  if (const auto known = fields_.find(key); known != fields_.end()) return known->second;
  const Field field = make();
  fields_.emplace(key, field);
  return field;
}

Field Lowering::distance(const Node& node, const Point& p) {
  if (auto* body = body_for(node)) return body->call("distance", body->lowering.distance(node, body->frame()), p);
  return once(node, p, Query::distance, [&] { return node.distance(Inputs(node, this), p); });
}

Field Lowering::membership(const Node& node, const Point& p, Border border) {
  const bool with_border = border == Border::included;
  if (auto* body = body_for(node))
    return body->call(with_border ? "inside" : "interior", body->lowering.membership(node, body->frame(), border), p);
  return once(node, p, with_border ? Query::inside : Query::interior, [&] {
    if (const auto own = node.membership(Inputs(node, this), p, border)) return *own;
    if (const auto inner = node.inner(p)) return membership(*node.inputs()[0], *inner, border);
    return at_most(distance(node, p), 0, border);
  });
}

Field Lowering::number(const NodeOutput& output, const Point& p) {
  return answer(*output.node, output.output, p).numbers[static_cast<size_t>(std::max(output.part, 0))];
}

OutputAnswer Lowering::answer(const Node& node, size_t output, const Point& p) {
  if (auto* body = body_for(node)) {
    OutputAnswer own = body->lowering.answer(node, output, body->frame());
    const std::string& name = node.type().outputs[output].name;
    for (Field& field : own.numbers)
      if (field) field = body->call(name, field, p);
    if (own.composition) own.composition = body->call(context_, std::move(*own.composition), p);
    return own;
  }
  Key key = key_of(node, p, Query::output);
  key.output = static_cast<uint32_t>(output);
  if (const auto known = answers_.find(key); known != answers_.end()) return known->second;
  const Inputs in(node, this);
  return answers_.emplace(key, node.answer(output, {in, p})).first->second;
}

Numbers4 Lowering::output(const Node& node, std::string_view name, const Point& p) {
  if (const auto own = node.type().output(name); own && node.gives(*own)) return answer(node, *own, p).numbers;
  if (auto* body = body_for(node)) {
    Numbers4 numbers = body->lowering.output(node, name, body->frame());
    for (Field& field : numbers)
      if (field) field = body->call(std::string(name), field, p);
    return numbers;
  }
  if (const auto passed = node.passed(Inputs(node, this), name, p)) return *passed;
  if (const auto inner = node.inner(p)) return output(*node.inputs()[0], name, *inner);
  std::optional<Numbers4> result;
  for (size_t i = node.inputs().size(); i-- > 0;) {
    const Node& input = *node.inputs()[i];
    if (!input.output_type(name)) continue;
    result = result ? select(inside(input, p), output(input, name, p), *result) : output(input, name, p);
  }
  return result.value_or(Numbers4{p.constant(0)});
}

Composition Lowering::default_composition(const Point& p) const {
  return Composition::pure(context_.materials().first().id, p.constant(1));
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
  return default_composition(p);
}

Field Lowering::attribute(const Node& node, std::string_view name, const Point& p, Demand demand) {
  if (auto* body = body_for(node))
    return body->call(std::string(name), body->lowering.attribute(node, name, body->frame(), demand), p);
  return make_attribute(node, name, p, demand);
}

Field Lowering::make_attribute(const Node& node, std::string_view name, const Point& p, Demand demand) {
  if (!has_attribute(node, name)) {
    const AttributeDeclaration* declared = declaration(name);
    return p.constant(declared ? default_of(*declared, name) : 0);
  }
  if (const auto own = node.attribute(Inputs(node, this), name, p, demand)) return *own;
  if (const auto inner = node.inner(p)) return attribute(*node.inputs()[0], name, *inner, demand);
  return attribute(*node.inputs()[0], name, p, demand);
}

std::vector<MaterialId> materials_of(const MaterialName& name, const MaterialTable& table) {
  if (name.material) return {name.material->id};
  const NodePtr not_held(NodePtr(), name.mixture.node);
  LoweringContext context(table, {not_held});
  program::Builder builder;
  Lowering lowering(context, builder);
  std::vector<MaterialId> ids;
  const OutputAnswer mixture = lowering.answer(*name.mixture.node, name.mixture.output, Point::origin_frame(builder));
  for (const auto& [id, fraction] : mixture.composition->fractions) ids.push_back(id);
  return ids;
}

bool Lowering::has_attribute(const Node& node, std::string_view name) {
  return context_.carries(node, attribute_of_part(name));
}

bool LoweringContext::carries(const Node& node, std::string_view attribute) {
  const auto declared = node.declares();
  if (declared && declared->name == attribute) return true;
  const auto some_input = [&] {
    return std::ranges::any_of(node.inputs(), [&](const NodePtr& input) { return carries(*input, attribute); });
  };
  if (!is_shared(node)) return some_input();
  // The answer is cached, since a node may be reached in very many ways.
  const std::pair key(&node, std::string(attribute));
  const auto known = [&]() -> std::optional<bool> {
    const std::scoped_lock lock(queries_mutex_);
    const auto found = carries_.find(key);
    return found != carries_.end() ? std::optional(found->second) : std::nullopt;
  };
  if (const auto answer = known()) return *answer;
  const bool answer = some_input();
  const std::scoped_lock lock(queries_mutex_);
  carries_.emplace(key, answer);
  return answer;
}

const AttributeDeclaration* Lowering::declaration(std::string_view name) const {
  for (const auto& attribute : context_.attributes_)
    if (attribute.name == attribute_of_part(name)) return &attribute;
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
  if (stands_alone_) return std::nullopt;  // tables cannot contain tables
  // Without a memory, the parts include the point's affine map, so that they are evaluated at the program's own inputs.
  // Parts that are kept for other programs do not include it.
  const auto map = context_.has_memory() ? std::nullopt : p.from_inputs();
  const ManyParts* parts = context_.many_parts(node, list, query, map.value_or(Affine{}), falloff);
  if (!parts) return std::nullopt;
  return parts->at(map ? Point::origin_frame(builder_) : p);
}

}  // namespace ombre::design
