#include "lang/vcad/node_calls.h"

#include <algorithm>

#include "base/text/text.h"
#include "lang/vcad/legacy_forms.h"
#include "lang/vcad/openscad.h"

namespace ombre::lang {

using design::NamedValue;
using design::NodePtr;
using design::NodeType;
using design::Reader;

namespace {

// Returns the number of the parameter that collects arguments with unknown names, or -1 if there is none.
int variables_of(const NodeType& type) {
  for (size_t n = 0; n < type.parameters.size(); ++n)
    if (type.parameters[n].takes_other_names) return static_cast<int>(n);
  return -1;
}

}  // namespace

std::optional<std::vector<NamedValue>> bound_arguments(const NodeType& type, std::vector<Argument> arguments,
                                                       const Reader& reader) {
  arguments = modern_arguments(type, std::move(arguments));
  std::vector<NamedValue> values;
  std::vector<bool> taken(type.parameters.size(), false);
  bool good = true;
  size_t position = 0, positional = 0;
  const int rest = variables_of(type);
  DataMembers variables;
  for (Argument& argument : arguments) {
    const SourceRange where = argument.name_where.source    ? argument.name_where
                              : argument.value.where.source ? argument.value.where
                                                            : reader.where;
    int index = -1;
    if (argument.name.empty()) {
      ++positional;
      while (position < taken.size() && taken[position]) ++position;
      if (position == taken.size()) {
        reader.diagnostics.error(Code::unknown_parameter, where,
                                 type.name + " takes at most " + std::to_string(type.parameters.size()) +
                                     " arguments: (" + join(type.parameter_names(), ", ") + ")");
        return std::nullopt;
      }
      index = static_cast<int>(position);
    } else {
      index = type.parameter(argument.name);
    }
    if (index < 0 && rest >= 0) {
      if (std::ranges::find(variables, argument.name, &DataMembers::value_type::first) != variables.end()) {
        reader.diagnostics.error(Code::twice, where, '"' + argument.name + "\" of " + type.name + " is given twice");
        good = false;
      }
      variables.emplace_back(argument.name, std::move(argument.value));
      continue;
    }
    if (index < 0) {
      std::string hint = openscad_argument_hint(type, argument.name);
      if (hint.empty()) hint = did_you_mean(argument.name, type.parameter_names());
      if (hint.empty())
        hint = type.parameters.empty() ? "it takes none" : "it has " + join(type.parameter_names(), ", ");
      reader.diagnostics.error(Code::unknown_parameter, where,
                               type.name + " has no parameter \"" + argument.name + "\"", hint,
                               {{"node", type.name},
                                {"parameter", argument.name},
                                {"similar", closest_name(argument.name, type.parameter_names()).value_or("")}});
      good = false;
      continue;
    }
    const auto at = static_cast<size_t>(index);
    if (is_block_of_openscad(type.name, type.parameters[at].name, argument.value)) {
      reader.diagnostics.error(Code::parameter_type, where, "cube has one side",
                               "for three write rectprism([30, 20, 10])");
      good = false;
      continue;
    }
    if (taken[at]) {
      reader.diagnostics.error(Code::twice, where,
                               "\"" + type.parameters[at].name + "\" of " + type.name + " is given twice");
      good = false;
      continue;
    }
    taken[at] = true;
    if (!argument.value.is_null()) values.push_back({&type.parameters[at], std::move(argument.value)});
  }
  if (!variables.empty() && taken[static_cast<size_t>(rest)]) {
    reader.diagnostics.error(
        Code::twice, reader.where,
        type.name + " gets values both by name and by \"" + type.parameters[static_cast<size_t>(rest)].name + '"',
        "write all of them one way");
    return std::nullopt;
  }
  if (!good) return std::nullopt;
  if (!variables.empty()) values.push_back({&type.parameters[static_cast<size_t>(rest)], Data(std::move(variables))});
  return values;
}

NodePtr joined(std::vector<NodePtr> nodes, const design::Registry& registry, const Reader& reader) {
  return nodes.size() == 1 ? nodes[0] : design::make_node(*registry.find("union"), {}, std::move(nodes), reader);
}

NodePtr make_called(const NodeType& type, const std::vector<NamedValue>& values, std::vector<NodePtr> inputs,
                    const design::Registry& registry, const Reader& reader) {
  if (type.inputs.most == 1 && inputs.size() > 1) {
    inputs = {joined(std::move(inputs), registry, reader)};
    if (!inputs[0]) return nullptr;
  }
  return design::make_node(type, values, std::move(inputs), reader);
}

}  // namespace ombre::lang
