#include "load/library_operators.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/text/text.h"
#include "design/domain.h"
#include "lang/engine/loader.h"
#include "lang/syntax/parser.h"
#include "load/library_folders.h"

namespace ombre::compile {

namespace fs = std::filesystem;

namespace {

// Returns the paths of all library files by the names that `use` gives them.
std::map<std::string, fs::path> library_files(const std::vector<std::string>& folders) {
  std::map<std::string, fs::path> files;
  for (const std::string& folder : folders) {
    std::error_code failed;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
      if (at->path().extension() == ".vcad")
        files.emplace(at->path().lexically_relative(folder).generic_string(), at->path());
  }
  return files;
}

std::vector<lang::Declaration> declarations_in(const fs::path& file) {
  auto text = lang::read_real_file(file.string());
  if (!text) return {};
  Diagnostics ignored;
  return lang::declarations_of(lang::parse(make_source(file.string(), std::move(*text)), ignored));
}

DataList choices_of(const lang::DeclaredParameter& parameter) {
  DataList choices;
  for (const auto& [value, label] : parameter.choices)
    choices.push_back(value.string() ? value : Data(format_number(*value.number())));
  return choices;
}

// Returns what a declared type says of the place of its numbers.
design::InSpace in_space(std::string_view type) {
  using enum design::InSpace;
  constexpr std::pair<std::string_view, design::InSpace> of_types[] = {
      {"point", point}, {"points", point}, {"curve", point}, {"direction", direction}, {"radius", radius}};
  const auto* found = std::ranges::find(of_types, type, &std::pair<std::string_view, design::InSpace>::first);
  return found == std::end(of_types) ? nothing : found->second;
}

Data limit(const std::optional<double>& number) { return number ? Data(*number) : Data(); }

DataMembers describe_parameter(const lang::DeclaredParameter& parameter) {
  const bool is_required = parameter.default_text.empty();
  return {{"name", parameter.name},
          {"doc", parameter.sentence},
          {"kind", parameter.type.empty() ? "any value" : parameter.type},
          {"python", "Any"},
          {"widget", parameter.choices.empty() ? "script" : "choice"},
          {"unit", parameter.unit},
          {"in_space", std::string(design::name_of(in_space(parameter.type)))},
          {"required", is_required},
          {"default", parameter.value ? *parameter.value : Data()},
          {"written_default", parameter.default_text},
          {"choices", choices_of(parameter)},
          {"variables", DataList()},
          {"least", limit(parameter.least)},
          {"step", limit(parameter.step)},
          {"most", limit(parameter.most)}};
}

}  // namespace

std::vector<Operator> operators_in(const std::vector<std::string>& folders) {
  std::vector<Operator> operators;
  for (const auto& [name, path] : library_files(folders))
    for (lang::Declaration& declaration : declarations_in(path)) operators.push_back({std::move(declaration), name});
  const auto category = [](const Operator& op) -> const std::string& { return op.declaration.category; };
  std::ranges::stable_sort(operators, {}, category);
  return operators;
}

std::string library_of(std::string_view name) {
  for (const Operator& op : operators_in(library_folders()))
    if (op.declaration.name == name) return op.library;
  return "";
}

DataMembers describe_operator(const Operator& op) {
  const lang::Declaration& declaration = op.declaration;
  DataList parameters, outputs;
  for (const lang::DeclaredParameter& parameter : declaration.parameters)
    parameters.emplace_back(describe_parameter(parameter));
  for (const lang::DeclaredOutput& output : declaration.outputs)
    outputs.emplace_back(DataMembers{
        {"name", output.name}, {"doc", output.unit}, {"type", output.type}, {"python", "Any"}, {"unit", output.unit}});
  return {{"name", declaration.name},
          {"category", declaration.category},
          {"sentence", declaration.sentence},
          {"parameters", std::move(parameters)},
          {"inputs", DataMembers{{"least", 0.0}, {"most", declaration.is_module ? Data() : Data(0.0)}}},
          {"gives", declaration.is_module ? "solid" : "values"},
          {"outputs", std::move(outputs)},
          {"example", declaration.example},
          {"source", declaration.source},
          {"library", op.library}};
}

}  // namespace ombre::compile
