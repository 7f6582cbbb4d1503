// `ombre nodes` lists the nodes that designs are built of.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/text/json.h"
#include "base/text/markdown.h"
#include "base/text/text.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/reference/list_or_page.h"
#include "jobs/reference/operator_text.h"
#include "load/node_data.h"
#include "load/node_registry.h"

namespace ombre::jobs {
namespace {

using design::NodeType;
using design::OutputInfo;
using design::ParameterInfo;

// Returns texts such as "mm, above 0" and "degrees, 0 to 90".
std::string domain_text(const design::Domain& domain) {
  std::vector<std::string> parts;
  if (!domain.unit.empty()) parts.emplace_back(domain.unit);
  const bool from = std::isfinite(domain.least), to = std::isfinite(domain.greatest);
  const std::string least = format_rounded(domain.least, 6), greatest = format_rounded(domain.greatest, 6);
  if (from && to) parts.push_back((domain.above_least ? "above " : "") + least + " to " + greatest);
  if (from && !to) parts.push_back(domain.above_least ? "above " + least : least + " or more");
  if (!from && to) parts.push_back("up to " + greatest);
  if (!domain.choices.empty()) parts.push_back(join(domain.choices, " | "));
  return join(parts, ", ");
}

std::string inputs_text(const design::InputInfo& inputs) {
  if (inputs.most == 0) return "none";
  const std::string least = std::to_string(inputs.least);
  if (inputs.least == inputs.most) return least + " solid";
  if (inputs.most == std::numeric_limits<size_t>::max()) return least + " or more, solid";
  return least + " to " + std::to_string(inputs.most) + ", solid";
}

std::string children_text(const design::InputInfo& inputs) {
  if (inputs.most == 0) return "";
  if (inputs.most == 1) return " Several children are joined first.";
  return inputs.least == inputs.most ? " Takes " + std::to_string(inputs.most) + " children."
                                     : " Any number of children.";
}

std::string parameter_text(const ParameterInfo& parameter) {
  std::string text = "  " + parameter.name + ": " + parameter.doc + '\n';
  std::string detail = parameter.text.kind;
  if (const std::string domain = domain_text(parameter.domain); !domain.empty()) detail += "; " + domain;
  if (parameter.domain.required) detail += "; required";
  if (!parameter.default_value.is_null()) detail += "; default " + print_json_line(parameter.default_value);
  return text + "      " + detail + '\n';
}

std::string describe(const NodeType& type) {
  std::string text = type.name + ": " + type.sentence + '\n';
  text += "category: " + type.category + "; inputs: " + inputs_text(type.inputs) +
          (type.is_solid() ? "; gives a solid\n" : "; gives values\n");
  if (!type.parameters.empty()) text += "parameters\n";
  for (const ParameterInfo& parameter : type.parameters) text += parameter_text(parameter);
  if (!type.outputs.empty()) text += "outputs\n";
  for (const OutputInfo& output : type.outputs)
    text += "  " + output.name + ": " + output.doc + "\n      " + output.type.name + '\n';
  if (!type.example.empty()) text += "example\n  " + type.example + '\n';
  return text;
}

void list_nodes(const Session& session) {
  const auto& types = compile::node_registry().types();
  size_t width = 0;
  for (const auto& type : types) width = std::max(width, type->name.size());
  std::string category;
  for (const auto& type : types) {
    if (session.events.wants_data()) {
      session.events.event("node", compile::describe_node(*type));
      continue;
    }
    if (type->category != category) session.events.print((category.empty() ? "" : "\n") + type->category + '\n');
    category = type->category;
    session.events.print("  " + type->name + std::string(width + 2 - type->name.size(), ' ') + type->sentence + '\n');
  }
  if (!session.events.wants_data()) session.events.print("\noperators of libraries\n");
  list_operators(session);
}

int show_node(const std::string& wanted, Session& session) {
  const design::Registry& registry = compile::node_registry();
  const NodeType* type = registry.find(wanted);
  if (!type && show_operator(wanted, session)) return done;
  if (!type) {
    const std::string hint = did_you_mean(wanted, names_with_operators(registry.names()));
    throw WrongArgument("there is no node \"" + wanted + "\"; " + (hint.empty() ? "ombre nodes lists them" : hint));
  }
  if (session.events.wants_data())
    session.events.event("node", compile::describe_node(*type));
  else
    session.events.print(describe(*type));
  return done;
}

// Returns the node reference: one section for each category, one table for each node.
std::string reference() {
  std::string text =
      "# Nodes\n\nMade by `ombre nodes --markdown`; `ombre nodes NAME` shows one. Lengths are mm, angles degrees.\n"
      "\"Number or field\" means that an expression in quotes or a [value](../user/values.md) may stand for the "
      "number.\n";
  std::string category;
  for (const auto& type : compile::node_registry().types()) {
    if (type->category != category) text += "\n## " + type->category + "\n";
    category = type->category;
    text += "\n### " + type->name + "\n\n" + type->sentence;
    text += children_text(type->inputs);
    text += "\n\n```\n" + type->example + "\n```\n";
    if (!type->parameters.empty()) text += "\n| parameter | is | default | |\n| --- | --- | --- | --- |\n";
    for (const ParameterInfo& parameter : type->parameters) {
      const std::string domain = domain_text(parameter.domain);
      text += table_row({"`" + parameter.name + "`", parameter.text.kind + (domain.empty() ? "" : ", " + domain),
                         parameter.domain.required           ? "required"
                         : parameter.default_value.is_null() ? "none"
                                                             : "`" + print_json_line(parameter.default_value) + "`",
                         parameter.doc});
    }
    if (!type->outputs.empty()) text += "\n| output | is | |\n| --- | --- | --- |\n";
    for (const OutputInfo& output : type->outputs)
      text += table_row({"`" + output.name + "`", output.type.name, output.doc});
  }
  return text;
}

constexpr OneThing one_node{"node", "A node's name, as in a design"};

}  // namespace

JobKind nodes_kind() {
  return one_or_all_kind<one_node, show_node, list_nodes, reference>(
      "nodes", "List what a design can be made of, or explain one node or operator",
      "Examples:\n  ombre nodes\n  ombre nodes sphere\n");
}

}  // namespace ombre::jobs
