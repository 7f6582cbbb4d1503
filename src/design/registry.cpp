#include "design/registry.h"

#include <algorithm>
#include <unordered_set>

#include "base/system/assert.h"
#include "base/text/text.h"

namespace ombre::design {

bool Node::is_nothing() const { return type().is_nothing; }

bool Node::is_mixture() const {
  return !type().is_solid() && type().outputs[first_output()].type.form == OutputForm::mixture;
}

std::vector<std::string> Node::output_names() const {
  std::vector<std::string> names;
  const NodePtr not_held(NodePtr(), this);
  // Constants, such as lists of points, are those of the node alone, whose frame they are in.
  const auto is_passed_up = [](const OutputInfo& output) { return output.type.form == OutputForm::numbers; };
  for (const Node* node : topological({not_held})) {
    if (!node->type().is_solid()) continue;
    const auto& outputs = node->type().outputs;
    for (size_t n = 0; n < outputs.size(); ++n)
      if (node->gives(n) && (node == this || is_passed_up(outputs[n]))) names.push_back(outputs[n].name);
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

const OutputType* Node::output_type(std::string_view output_name) const {
  const auto own = type().output(output_name);
  if (own && gives(*own)) return &type().outputs[*own].type;
  for (const NodePtr& input : inputs())
    if (const OutputType* found = input->output_type(output_name)) return found;
  return nullptr;
}

std::optional<size_t> NodeType::output(std::string_view output_name) const {
  const auto found = std::ranges::find(outputs, output_name, &OutputInfo::name);
  return found == outputs.end() ? std::nullopt : std::optional(static_cast<size_t>(found - outputs.begin()));
}

int NodeType::parameter(std::string_view parameter_name) const {
  const std::string folded = fold_name(parameter_name);
  for (size_t i = 0; i < parameters.size(); ++i)
    if (fold_name(parameters[i].name) == folded) return static_cast<int>(i);
  return -1;
}

std::vector<std::string> NodeType::parameter_names() const {
  std::vector<std::string> names;
  for (const ParameterInfo& parameter : parameters) names.push_back(parameter.name);
  return names;
}

void Registry::add_type(std::unique_ptr<NodeType> type) {
  const bool is_new = by_name_.emplace(fold_name(type->name), type.get()).second;
  ASSERT(is_new && "two nodes have one name");
  if (type->is_nothing) nothing_ = type.get();
  for (const auto& other : types_) other->nothing = nothing_;
  type->nothing = nothing_;
  types_.push_back(std::move(type));
}

const NodeType* Registry::find(std::string_view name) const {
  const auto it = by_name_.find(fold_name(name));
  return it == by_name_.end() ? nullptr : it->second;
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> names;
  for (const auto& type : types_) names.push_back(type->name);
  return names;
}

namespace {

std::vector<std::string> names_of(const std::vector<std::unique_ptr<NodeType>>& types, bool are_solids) {
  std::vector<std::string> names;
  for (const auto& type : types)
    if (type->is_solid() == are_solids) names.push_back(type->name);
  return names;
}

}  // namespace

std::vector<std::string> Registry::solid_names() const { return names_of(types_, true); }
std::vector<std::string> Registry::value_names() const { return names_of(types_, false); }

namespace {

// Returns an example, which is written as a script.
Phrase example_of(const NodeType& type) {
  if (type.example.empty()) return {};
  return spelled::either("for example " + type.example, "ombre nodes " + type.name + " says what it takes",
                         "help(ombre." + type.name + ") says what it takes");
}

bool check_inputs(const NodeType& type, const std::vector<NodePtr>& inputs, const Reader& reader) {
  const InputInfo& wanted = type.inputs;
  const auto fail = [&](const std::string& message, const Phrase& hint) {
    reader.diagnostics.error(Code::inputs, reader.where, message, hint);
    return false;
  };
  if (wanted.most == 0 && !inputs.empty())
    return fail(type.name + " takes no children",
                spelled::either("end it with \";\"", "leave \"inputs\" out", "give it none"));
  if (!inputs.empty() && inputs.size() < wanted.least)
    return fail(type.name + " takes " + std::to_string(wanted.least) + " inputs, " + std::to_string(inputs.size()) +
                    (inputs.size() == 1 ? " was given" : " were given"),
                example_of(type));
  if (inputs.size() < wanted.least)
    return fail(type.name + " works on solids, and none is given",
                "write " + spelled::either(type.name + "(...) { sphere(5); }", "\"inputs\": [\"n1\"]",
                                           "ombre." + type.name + "(ombre.sphere(5), ...)"));
  if (inputs.size() > wanted.most)
    return fail(
        type.name + " takes " + std::to_string(wanted.most) + (wanted.most == 1 ? " input, " : " inputs, ") +
            std::to_string(inputs.size()) + " were given",
        spelled::either("join them with union", "join them with a node \"union\"", "join them with ombre.union"));
  for (const NodePtr& input : inputs)
    if (!input->type().is_solid())
      return fail(type.name + " takes solids, " + input->type().name + " gives values",
                  "give it as a parameter, for example " +
                      spelled::either("sphere(5 + noise());", R"("radius": {"from": "n3", "output": "value"})",
                                      "ombre.sphere(5 + ombre.noise())"));
  return true;
}

bool is_nothing(const NodePtr& input) { return input->is_nothing(); }

// Removes empty inputs. Returns an empty solid if the node would then be empty, else null.
NodePtr nothing_of(const NodeType& type, std::vector<NodePtr>& inputs) {
  const OfNothing rule = type.inputs.of_nothing;
  const auto first = std::ranges::find_if(inputs, is_nothing);
  if (first == inputs.end() || rule == OfNothing::counts) return nullptr;
  NodePtr nothing = *first;
  if (rule == OfNothing::gives_nothing) return nothing;
  if (rule == OfNothing::cuts_nothing && first == inputs.begin()) return nothing;
  std::erase_if(inputs, is_nothing);
  return inputs.empty() ? nothing : nullptr;
}

// Value nodes with the numbers of the parameters that hold them.
using UsedValues = std::vector<std::pair<size_t, NodePtr>>;

// Returns each node once, sorted by parameter, whatever order the parameters were given in.
std::vector<NodePtr> each_once(UsedValues used) {
  std::ranges::stable_sort(used, {}, [](const auto& value) { return value.first; });
  std::vector<NodePtr> nodes;
  std::unordered_set<const Node*> known;
  for (const auto& [parameter, node] : used)
    if (known.insert(node.get()).second) nodes.push_back(node);
  return nodes;
}

// Returns false and adds a diagnostic if the node exceeds the limits of designs.
bool fits(const NodeType& type, const std::vector<NodePtr>& inputs, const std::vector<NodePtr>& values,
          const Reader& reader) {
  const auto is_too_deep = [](const NodePtr& other) { return other->depth() >= deepest_design; };
  const bool deep = std::ranges::any_of(inputs, is_too_deep) || std::ranges::any_of(values, is_too_deep);
  if (deep)
    reader.diagnostics.error(Code::limit, reader.where,
                             "the design nests deeper than " + std::to_string(deepest_design) + " nodes");
  if (values.size() > most_values)
    reader.diagnostics.error(Code::limit, reader.where,
                             type.name + " holds more than " + std::to_string(most_values) + " values");
  return !deep && values.size() <= most_values;
}

}  // namespace

NodePtr make_nothing(const NodeType& type, const SourceRange& where) {
  if (!type.nothing) return nullptr;
  const std::shared_ptr<Node> node = type.nothing->create();
  node->finish({}, {}, where);
  return node;
}

namespace {

NodePtr made_node(const NodeType& type, const std::vector<NamedValue>& values, std::vector<NodePtr> inputs,
                  const Reader& reader) {
  const std::shared_ptr<Node> node = type.create();
  bool good = true;
  std::vector<bool> given(type.parameters.size(), false);
  UsedValues used;
  for (const auto& [parameter, data] : values) {
    const auto index = static_cast<size_t>(parameter - type.parameters.data());
    given[index] = true;
    std::vector<NodePtr> nodes;
    const Reader one{reader.materials, reader.diagnostics, reader.loader, reader.where, type.name,
                     parameter->name,  reader.names,       &nodes,        &inputs};
    const auto constants = with_constants(data);
    good = type.set(*node, index, constants ? *constants : data, one) && good;
    for (NodePtr& value : nodes) used.emplace_back(index, std::move(value));
  }
  const bool has_unwanted = type.inputs.most == 0 && !inputs.empty();
  bool has_all = true;
  for (size_t i = 0; i < given.size(); ++i) {
    if (given[i] || !type.parameters[i].domain.required) continue;
    reader.diagnostics.error(Code::parameter_missing, reader.where,
                             type.name + (has_unwanted && has_all ? " takes no children; it needs \"" : " needs \"") +
                                 type.parameters[i].name + "\": " + type.parameters[i].doc,
                             example_of(type), {{"node", type.name}, {"parameter", type.parameters[i].name}});
    has_all = false;
  }
  if (has_all || !has_unwanted) good = check_inputs(type, inputs, reader) && good;
  if (!good || !has_all) return nullptr;
  if (type.makes_nothing(*node)) return make_nothing(type, reader.where);
  if (NodePtr nothing = nothing_of(type, inputs)) return nothing;
  const Reader whole{reader.materials, reader.diagnostics, reader.loader, reader.where, type.name, ""};
  if (!type.complete(*node, whole, inputs)) return nullptr;
  const std::vector<NodePtr> values_used = each_once(std::move(used));
  if (!fits(type, inputs, values_used, reader)) return nullptr;
  node->finish(std::move(inputs), values_used, reader.where);
  return node;
}

}  // namespace

NodePtr make_node(const NodeType& type, const std::vector<NamedValue>& values, std::vector<NodePtr> inputs,
                  const Reader& reader) {
  const size_t known = reader.diagnostics.list().size();
  NodePtr node = made_node(type, values, std::move(inputs), reader);
  reader.diagnostics.tell_code(known, Code::parameters, {{"node", type.name}});
  return node;
}

}  // namespace ombre::design
