#include "jobs/reference/operator_text.h"

#include <algorithm>

#include "base/text/markdown.h"
#include "base/text/text.h"
#include "load/library_folders.h"
#include "load/library_operators.h"

namespace ombre::jobs {
namespace {

using compile::Operator;
using lang::Declaration;
using lang::DeclaredOutput;
using lang::DeclaredParameter;

std::vector<Operator> all_operators() { return compile::operators_in(compile::library_folders()); }

std::string range_text(const DeclaredParameter& parameter) {
  if (parameter.least && parameter.most)
    return format_number(*parameter.least) + " to " + format_number(*parameter.most);
  if (parameter.least) return format_number(*parameter.least) + " or more";
  return parameter.most ? "up to " + format_number(*parameter.most) : "";
}

std::string choices_text(const DeclaredParameter& parameter) {
  std::vector<std::string> words;
  for (const auto& [value, label] : parameter.choices) {
    const std::string word = value.string() ? *value.string() : format_number(*value.number());
    std::string text = word;
    if (word != label) text.append(" (").append(label).append(")");
    words.push_back(std::move(text));
  }
  return join(words, " or ");
}

// Returns what a parameter takes: "value, mm, 1 to 20".
std::string kind_text(const DeclaredParameter& parameter) {
  std::vector<std::string> parts{parameter.type.empty() ? "any value" : parameter.type};
  for (const std::string& part : {parameter.unit, range_text(parameter), choices_text(parameter)})
    if (!part.empty()) parts.push_back(part);
  return join(parts, ", ");
}

std::string output_text(const DeclaredOutput& output) {
  return output.type + (output.unit.empty() ? "" : ", " + output.unit);
}

std::string use_line(const Operator& op) { return "use <" + op.library + ">"; }

std::string parameter_text(const DeclaredParameter& parameter) {
  const std::string given = parameter.default_text.empty() ? "; required" : "; default " + parameter.default_text;
  return "  " + parameter.name + (parameter.sentence.empty() ? "" : ": " + parameter.sentence) + "\n      " +
         kind_text(parameter) + given + '\n';
}

std::string describe(const Operator& op) {
  const Declaration& declared = op.declaration;
  std::string text = declared.name + ": " + declared.sentence + "\ncategory: " + declared.category + "; " +
                     use_line(op) + (declared.is_module ? "; gives solids\n" : "; gives values\n");
  if (!declared.parameters.empty()) text += "parameters\n";
  for (const DeclaredParameter& parameter : declared.parameters) text += parameter_text(parameter);
  if (!declared.outputs.empty()) text += "outputs\n";
  for (const DeclaredOutput& output : declared.outputs)
    text += "  " + (output.name.empty() ? "" : output.name + ": ") + output_text(output) + '\n';
  if (!declared.example.empty()) text += "example\n";
  for (const std::string& line : split(declared.example, '\n'))
    if (!line.empty()) text += "  " + line + '\n';
  if (!declared.source.empty()) text += "source: " + declared.source + '\n';
  return text;
}

std::string section(const Operator& op) {
  const Declaration& declared = op.declaration;
  std::string text = "\n### " + declared.name + "\n\n" + declared.sentence;
  text += declared.is_module ? "\n" : " Gives values.\n";
  text += "\n```\n" + use_line(op) + '\n' + declared.example + "\n```\n";
  text += "\n![" + declared.name + "](operators/" + declared.name + ".png)\n";
  if (!declared.parameters.empty()) text += "\n| parameter | is | default | |\n| --- | --- | --- | --- |\n";
  for (const DeclaredParameter& parameter : declared.parameters)
    text += table_row({"`" + parameter.name + "`", kind_text(parameter),
                       parameter.default_text.empty() ? "required" : "`" + parameter.default_text + "`",
                       parameter.sentence});
  if (!declared.outputs.empty()) text += "\n| output | is |\n| --- | --- |\n";
  for (const DeclaredOutput& output : declared.outputs)
    text += table_row({output.name.empty() ? "" : "`" + output.name + "`", output_text(output)});
  if (!declared.source.empty()) text += "\nSource: " + declared.source + ".\n";
  return text;
}

}  // namespace

void list_operators(const Session& session) {
  const std::vector<Operator> operators = all_operators();
  size_t width = 0;
  for (const Operator& op : operators) width = std::max(width, op.declaration.name.size());
  std::string category;
  for (const Operator& op : operators) {
    const Declaration& declared = op.declaration;
    if (session.events.wants_data()) {
      session.events.event("operator", compile::describe_operator(op));
      continue;
    }
    if (declared.category != category) session.events.print('\n' + declared.category + '\n');
    category = declared.category;
    session.events.print("  " + declared.name + std::string(width + 2 - declared.name.size(), ' ') + declared.sentence +
                         '\n');
  }
}

bool show_operator(const std::string& name, Session& session) {
  const std::vector<Operator> operators = all_operators();
  bool is_known = false;
  for (const Operator& op : operators) {
    if (op.declaration.name != name) continue;
    is_known = true;
    if (session.events.wants_data())
      session.events.event("operator", compile::describe_operator(op));
    else
      session.events.print(describe(op));
  }
  return is_known;
}

std::vector<std::string> names_with_operators(std::vector<std::string> names) {
  for (const Operator& op : all_operators()) names.push_back(op.declaration.name);
  return names;
}

std::string operators_reference() {
  std::string text =
      "# Operators\n\nMade by `ombre operators --markdown`; `ombre operators NAME` shows one. Operators are modules "
      "and "
      "functions of\nlibraries in Ombre's own language ([how to use and write them](../user/operators.md)). Lengths "
      "are "
      "mm, angles degrees.\nA `value` may vary in space.\n";
  std::string category;
  for (const Operator& op : compile::operators_in(compile::own_library_folders())) {
    if (op.declaration.category != category) text += "\n## " + op.declaration.category + '\n';
    category = op.declaration.category;
    text += section(op);
  }
  return text;
}

}  // namespace ombre::jobs
