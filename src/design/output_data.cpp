// Outputs of value nodes, and formulas with them, as data.
#include <algorithm>

#include "base/system/assert.h"
#include "base/text/text.h"
#include "design/attributes.h"
#include "design/outputs.h"
#include "design/registry.h"

namespace ombre::design {
namespace {

const NodeOutput& output_of(const expr::Input& input) {
  const auto* output = dynamic_cast<const OutputInput*>(&input);
  ASSERT(output && "formulas of designs hold outputs of nodes");
  return output->output();
}

}  // namespace

std::vector<NodePtr> nodes_of(const expr::Expression& expression) {
  std::vector<NodePtr> nodes;
  for (const expr::InputPtr& input : expression.inputs()) {
    const NodePtr& node = output_of(*input).node;
    if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
  }
  return nodes;
}

std::string NodeObject::describe() const {
  const NodeType& type = node_->type();
  return type.is_solid() ? "a " + type.name : "a value of " + type.name;
}

namespace {

const NodeObject* node_object(const Data& data) { return dynamic_cast<const NodeObject*>(data.host_object().get()); }
const FormulaObject* formula_object(const Data& data) {
  return dynamic_cast<const FormulaObject*>(data.host_object().get());
}

// A node with the output and coordinate that a text selects.
struct Named {
  NodePtr node;
  size_t output = 0;
  int axis = -1;
  const OutputInfo& info() const { return node->type().outputs[output]; }
};

std::string given_outputs(const Node& node) {
  std::vector<std::string> names;
  for (size_t i = 0; i < node.type().outputs.size(); ++i)
    if (node.gives(i)) names.push_back(node.type().outputs[i].name);
  return node.type().name + " gives " + join(names, ", ");
}

bool fail(const Data& at, const Reader& reader, const std::string& message, const Phrase& hint = {},
          Code code = Code::parameter_type) {
  reader.diagnostics.error(code, at.where.source ? at.where : reader.where, message, hint);
  return false;
}

bool find_output(const Data& at, const std::string& text, const Reader& reader, Named& named) {
  const size_t dot = text.find('.');
  const auto& outputs = named.node->type().outputs;
  const auto found = std::ranges::find(outputs, text.substr(0, dot), &OutputInfo::name);
  const auto number = static_cast<size_t>(found - outputs.begin());
  if (found == outputs.end() || !named.node->gives(number))
    return fail(at, reader, "this " + named.node->type().name + " has no output \"" + text + '"',
                given_outputs(*named.node), Code::unknown_output);
  named.output = number;
  if (dot == std::string::npos) return true;
  const std::string part = text.substr(dot + 1);
  const size_t axis = part.size() == 1 ? std::string_view("xyz").find(part[0]) : std::string_view::npos;
  if (axis == std::string_view::npos || found->type != ValueType::vector)
    return fail(at, reader, '"' + text + "\" is no output", "vectors have the parts .x, .y and .z");
  named.axis = static_cast<int>(axis);
  return true;
}

std::optional<Named> read_output(const Data& data, const Reader& reader) {
  if (const NodeObject* object = node_object(data)) {
    if (!object->node()->type().is_solid()) return Named{object->node(), object->node()->first_output()};
    fail(data, reader, "expected a value, found a solid");
    return std::nullopt;
  }
  const Data *from = data.find("from"), *output = data.find("output");
  const NodeObject* object = from ? node_object(*from) : nullptr;
  if (!object || object->node()->type().is_solid() || !output || !output->string()) {
    fail(data, reader, "expected an output of a node that gives values",
         "write for example {\"from\": \"n3\", \"output\": \"value\"}");
    return std::nullopt;
  }
  Named named{object->node()};
  return find_output(*output, *output->string(), reader, named) ? std::optional(named) : std::nullopt;
}

std::optional<expr::Expression> number_of(const Data& data, const Reader& reader) {
  const auto named = read_output(data, reader);
  if (!named) return std::nullopt;
  const ValueType type = named->info().type;
  if (type == ValueType::number || named->axis >= 0) return expression_of({named->node, named->output, named->axis});
  if (type == ValueType::vector)
    fail(data, reader,
         "expected a number, found the vector \"" + named->info().name + "\" of " + named->node->type().name,
         "write one of its parts: ." + named->info().name + ".x");
  else
    fail(data, reader, "expected a number, found the mixture of materials of " + named->node->type().name,
         "a mixture goes where a solid has its material");
  return std::nullopt;
}

// Reads {"formula": "2*v", "with": {"v": ...}}.
std::optional<expr::Expression> formula_with(const Data& data, const Domain& domain, const Reader& reader) {
  const Data *formula = data.find("formula"), *with = data.find("with");
  if (!formula->string() || (with && !with->members())) {
    fail(data, reader, "expected a formula in quotes, and an object \"with\" the values that it names");
    return std::nullopt;
  }
  const auto expression = expr::Expression::parse(*formula->string(), formula->where, reader.diagnostics);
  if (!expression) return std::nullopt;
  std::vector<std::string> known = known_variables(domain);
  std::map<std::string, expr::Expression> values;
  for (const auto& [name, value] : with ? *with->members() : DataMembers{}) {
    const auto number = number_of(value, reader);
    if (!number) return std::nullopt;
    values.emplace(name, *number);
    known.push_back(name);
  }
  if (domain.child_attributes && reader.inputs)
    for (const std::string& name : names_of_attributes(*reader.inputs)) known.push_back(name);
  if (!expression->check_variables(known, *formula->string(), formula->where, reader.diagnostics)) return std::nullopt;
  return expression->with_substitutes([&](const expr::Node& variable) {
    const auto value = values.find(variable.name);
    return value == values.end() ? std::nullopt : std::optional(value->second);
  });
}

}  // namespace

bool is_value(const Data& data) { return node_object(data) || formula_object(data) || data.members(); }

bool is_mixture(const Data& data) {
  const Data* from = data.find("from");
  const NodeObject* object = node_object(from ? *from : data);
  if (!object || object->node()->type().is_solid()) return false;
  const Node& node = *object->node();
  const size_t mixture = node.type().mixture_output();
  const Data* output = data.find("output");
  if (!output) return node.first_output() == mixture;
  return output->string() && mixture < node.type().outputs.size() &&
         node.type().outputs[mixture].name == *output->string();
}

std::optional<expr::Expression> read_formula(const Data& data, const Domain& domain, const Reader& reader) {
  if (const FormulaObject* object = formula_object(data)) return object->expression();
  return data.find("formula") ? formula_with(data, domain, reader) : number_of(data, reader);
}

std::vector<expr::Expression> vector_of(const Data& data, const Reader& reader) {
  if (!node_object(data) && !data.find("from")) return {};
  Diagnostics ignored;
  const auto named = read_output(data, {reader.materials, ignored, nullptr, reader.where, reader.node, reader.name});
  if (!named || named->axis >= 0 || named->info().type != ValueType::vector) return {};
  std::vector<expr::Expression> numbers;
  for (int axis = 0; axis < 3; ++axis) numbers.push_back(expression_of({named->node, named->output, axis}));
  return numbers;
}

Data write_solid(const Node& node) {
  const NodePtr not_held(NodePtr(), &node);
  return Data(DataMembers{{"from", Data(HostObjectPtr(std::make_shared<NodeObject>(not_held)))}});
}

NodePtr read_solid(const Data& data, const Reader& reader) {
  const Data* named = data.find("from");
  const NodeObject* object = node_object(named ? *named : data);
  if (object && object->node()->type().is_solid() && !object->node()->is_nothing()) return object->node();
  const std::string found = object && object->node()->is_nothing() ? "nothing" : describe(data);
  fail(data, reader,
       std::string(reader.name) + " of " + std::string(reader.node) + ": expected a solid, found " + found,
       spelled::either("write a call of one, for example sphere(5)", "write the id of its node, {\"from\": \"n2\"}",
                       "write a call of one, for example ombre.sphere(5)"));
  return nullptr;
}

NodePtr read_mixture(const Data& data, const Reader& reader) {
  if (!formula_object(data)) {
    const auto named = read_output(data, reader);
    if (!named) return nullptr;
    if (named->info().type == ValueType::mixture) return named->node;
  }
  fail(data, reader,
       std::string(reader.name) + " of " + std::string(reader.node) +
           ": expected a material or a mixture of materials, found a number that varies in space",
       "write for example " + spelled::either("mix(white, black, t)", R"({"from": "n3", "output": "mixture"})",
                                              R"(ombre.mix("white", "black", t))"));
  return nullptr;
}

namespace {

Data reference(const NodePtr& node, const std::string& output) {
  return Data(DataMembers{{"from", Data(HostObjectPtr(std::make_shared<NodeObject>(node)))}, {"output", Data(output)}});
}

}  // namespace

Data write_formula(const expr::Expression& expression) {
  const auto written = [](const expr::Input& input) {
    return reference(output_of(input).node, output_of(input).name());
  };
  const auto& inputs = expression.inputs();
  if (expression.size() == 1) return written(*inputs[0]);
  DataMembers with;
  for (size_t i = 0; i < inputs.size(); ++i) with.emplace_back(expression.input_name(i), written(*inputs[i]));
  return Data(DataMembers{{"formula", Data(expression.text())}, {"with", Data(std::move(with))}});
}

Data write_mixture(const Node& node) {
  const NodePtr not_held(NodePtr(), &node);
  return reference(not_held, node.type().outputs[node.type().mixture_output()].name);
}

namespace {

// Replaces each NodeObject by other data.
template <class Other>
Data replaced(const Data& data, const Other& other) {
  if (const NodeObject* object = node_object(data)) return other(*object);
  if (const DataList* list = data.list()) {
    DataList result;
    for (const Data& element : *list) result.push_back(replaced(element, other));
    return Data(std::move(result), data.where);
  }
  const DataMembers* members = data.members();
  if (!members) return data;
  DataMembers result;
  for (const auto& [key, value] : *members) result.emplace_back(key, replaced(value, other));
  return Data(std::move(result), data.where);
}

}  // namespace

Data with_names(const Data& data, const std::function<std::string(const Node&)>& name) {
  return replaced(data, [&](const NodeObject& object) { return Data(name(*object.node())); });
}

Data with_held_nodes(const Data& data, std::span<const NodePtr> nodes) {
  return replaced(data, [&](const NodeObject& object) {
    const auto held = std::ranges::find(nodes, object.node());
    ASSERT(held != nodes.end() && "a node holds the nodes whose outputs it uses");
    return Data(HostObjectPtr(std::make_shared<NodeObject>(*held)));
  });
}

}  // namespace ombre::design
