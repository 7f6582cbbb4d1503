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

// A node with the output and part that a text selects.
struct Named : NodeOutput {
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
  const size_t position = part.size() == 1 ? found->type.parts.find(part[0]) : std::string_view::npos;
  if (position == std::string_view::npos)
    return fail(at, reader, '"' + text + "\" is no output", "vectors have the parts .x, .y and .z, colours .r to .a");
  named.part = static_cast<int>(position);
  return true;
}

std::optional<Named> read_output(const Data& data, const Reader& reader) {
  if (const NodeObject* object = node_object(data)) {
    if (!object->node()->type().is_solid()) return Named{{object->node(), object->node()->first_output()}};
    fail(data, reader, "expected a value, found a solid");
    return std::nullopt;
  }
  const Data *from = data.find("from"), *output = data.find("output");
  const NodeObject* object = from ? node_object(*from) : nullptr;
  if (!object || !output || !output->string()) {
    fail(data, reader, "expected an output of a node that gives values",
         "write for example {\"from\": \"n3\", \"output\": \"value\"}");
    return std::nullopt;
  }
  Named named{{object->node()}};
  return find_output(*output, *output->string(), reader, named) ? std::optional(named) : std::nullopt;
}

std::optional<expr::Expression> number_of(const Data& data, const Reader& reader) {
  const auto named = read_output(data, reader);
  if (!named) return std::nullopt;
  const OutputType& type = named->info().type;
  if (type.is_number() || named->part >= 0) return expression_of(*named);
  const std::string of = " of " + named->node->type().name;
  if (type.has_parts())
    fail(data, reader, "expected a number, found the " + type.name + " \"" + named->info().name + '"' + of,
         "write one of its parts: ." + named->info().name + '.' + type.parts[0]);
  else if (type.form == OutputForm::mixture)
    fail(data, reader, "expected a number, found the mixture of materials" + of,
         "a mixture goes where a solid has its material");
  else
    fail(data, reader, "expected a number, found the " + type.name + " \"" + named->info().name + '"' + of);
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

namespace {

// Returns the output that data stands for, if it stands for one and for no part of it.
std::optional<GivenOutput> given_output(const Data& data) {
  const Data* from = data.find("from");
  const NodeObject* object = node_object(from ? *from : data);
  if (!object) return std::nullopt;
  const Node& node = *object->node();
  const Data* output = data.find("output");
  if (!output) return node.type().is_solid() ? std::nullopt : std::optional(GivenOutput{&node, node.first_output()});
  const auto number = output->string() ? node.type().output(*output->string()) : std::nullopt;
  return number && node.gives(*number) ? std::optional(GivenOutput{&node, *number}) : std::nullopt;
}

bool has_form(const std::optional<GivenOutput>& given, OutputForm form) {
  return given && given->node->type().outputs[given->output].type.form == form;
}

}  // namespace

bool is_mixture(const Data& data) { return has_form(given_output(data), OutputForm::mixture); }

std::optional<Data> with_constants(const Data& data) {
  if (const DataList* list = data.list()) {
    std::optional<DataList> result;
    for (size_t n = 0; n < list->size(); ++n) {
      auto constant = with_constants((*list)[n]);
      if (!constant) continue;
      if (!result) result = *list;
      (*result)[n] = std::move(*constant);
    }
    return result ? std::optional(Data(std::move(*result), data.where)) : std::nullopt;
  }
  const auto given = is_value(data) ? given_output(data) : std::nullopt;
  if (!has_form(given, OutputForm::constant)) return std::nullopt;
  Data constant = given->node->constant(given->output);
  constant.where = data.where;
  return constant;
}

std::optional<expr::Expression> read_formula(const Data& data, const Domain& domain, const Reader& reader) {
  if (const FormulaObject* object = formula_object(data)) return object->expression();
  return data.find("formula") ? formula_with(data, domain, reader) : number_of(data, reader);
}

std::vector<expr::Expression> vector_of(const Data& data, const Reader& reader) {
  if (!node_object(data) && !data.find("from")) return {};
  Diagnostics ignored;
  const auto named = read_output(data, {reader.materials, ignored, nullptr, reader.where, reader.node, reader.name});
  if (!named || named->part >= 0) return {};
  std::vector<expr::Expression> numbers;
  for (size_t part = 0; part < named->info().type.parts.size(); ++part)
    numbers.push_back(expression_of({named->node, named->output, static_cast<int>(part)}));
  return numbers;
}

std::optional<GivenOutput> read_solid(const Data& data, const Reader& reader) {
  const Data* from = data.find("from");
  const NodeObject* object = node_object(from ? *from : data);
  if (const auto given = given_output(data); object && has_form(given, OutputForm::solid)) {
    reader.keep(object->node());
    return given;
  }
  if (object && !data.find("output") && object->node()->type().is_solid() && !object->node()->is_nothing()) {
    reader.keep(object->node());
    return GivenOutput{object->node().get()};
  }
  const std::string found = object && object->node()->is_nothing() ? "nothing" : describe(data);
  fail(data, reader,
       std::string(reader.name) + " of " + std::string(reader.node) + ": expected a solid, found " + found,
       spelled::either("write a call of one, for example sphere(5)", "write the id of its node, {\"from\": \"n2\"}",
                       "write a call of one, for example ombre.sphere(5)"));
  return std::nullopt;
}

std::optional<GivenOutput> read_mixture(const Data& data, const Reader& reader) {
  if (!formula_object(data)) {
    const auto named = read_output(data, reader);
    if (!named) return std::nullopt;
    if (named->info().type.form == OutputForm::mixture) {
      reader.keep(named->node);
      return GivenOutput{named->node.get(), named->output};
    }
  }
  fail(data, reader,
       std::string(reader.name) + " of " + std::string(reader.node) +
           ": expected a material or a mixture of materials, found a number that varies in space",
       "write for example " + spelled::either("mix(white, black, t)", R"({"from": "n3", "output": "mixture"})",
                                              R"(ombre.mix("white", "black", t))"));
  return std::nullopt;
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

Data write_output(const GivenOutput& output, const NodePtr& owner) {
  return reference(NodePtr(owner, output.node), output.node->type().outputs[output.output].name);
}

Data write_solid(const GivenOutput& solid) {
  if (!solid.node->type().is_solid()) return write_output(solid);
  const NodePtr not_held(NodePtr(), solid.node);
  return Data(DataMembers{{"from", Data(HostObjectPtr(std::make_shared<NodeObject>(not_held)))}});
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
