#include "lang/openscad/customizer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text/json.h"
#include "base/text/text.h"
#include "lang/syntax/parser.h"

namespace ombre::lang::openscad {
namespace {

struct Comment {
  size_t begin, end;  // including the comment signs
  std::string text;   // text without the comment signs
  bool is_block;
};

// The comments of a script, and the first brace outside comments and strings.
struct Outline {
  std::vector<Comment> comments;
  size_t first_brace = std::string::npos;
};

Outline outline_of(std::string_view text) {
  Outline outline;
  for (size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at)
        if (text[at] == '\\') ++at;
    } else if (text[at] == '{') {
      outline.first_brace = std::min(outline.first_brace, at);
    } else if (text.substr(at, 2) == "//") {
      const size_t end = std::min(text.find_first_of(line_ends, at), text.size());
      outline.comments.push_back({at, end, std::string(trim(text.substr(at + 2, end - at - 2))), false});
      at = end;
    } else if (text.substr(at, 2) == "/*") {
      const size_t close = text.find("*/", at + 2);
      if (close == std::string_view::npos) break;
      outline.comments.push_back({at, close + 2, std::string(trim(text.substr(at + 2, close - at - 2))), true});
      at = close + 1;
    }
  }
  return outline;
}

// Interprets the comment after a value.
void read_widget(const std::string& comment, Parameter& parameter) {
  if (parameter.value.boolean()) return;
  if (comment.size() > 1 && comment.front() == '[' && comment.back() == ']') {
    const std::string_view inside = std::string_view(comment).substr(1, comment.size() - 2);
    const bool is_list = inside.find(',') != std::string_view::npos || parameter.value.string();
    const bool is_vector = parameter.kind == Parameter::Kind::vector;
    if (is_vector || !is_list)
      if (read_range(inside, parameter) || is_vector) return;
    read_choices(inside, parameter.value.string() != nullptr, parameter);
    parameter.kind = Parameter::Kind::choice;
    return;
  }
  const auto number = parse_number(comment);
  if (!number) return;
  if (parameter.kind == Parameter::Kind::text)
    parameter.longest = *number > 0 && *number < 1e9 ? std::optional(static_cast<size_t>(*number)) : std::nullopt;
  else
    parameter.step = *number;
}

Parameter::Kind kind_of(const Data& value) {
  if (value.boolean()) return Parameter::Kind::boolean;
  if (value.string()) return Parameter::Kind::text;
  return value.list() ? Parameter::Kind::vector : Parameter::Kind::number;
}

// They stand in the order of Parameter::Kind.
constexpr std::array kind_names{"number", "boolean", "text", "vector", "choice"};
static_assert(kind_names.size() == static_cast<size_t>(Parameter::Kind::choice) + 1);

bool is_section(const Comment& comment) {
  return comment.is_block && comment.text.size() > 2 && comment.text.front() == '[' && comment.text.back() == ']';
}

void read_comments(const SourceText& source, const Outline& outline, const ast::Assign& assign, Parameter& parameter) {
  const int line = source.place(assign.span.begin).line, last = source.place(assign.span.end).line;
  for (const Comment& comment : outline.comments) {
    const int at = source.place(comment.begin).line;
    if (is_section(comment) && comment.begin < assign.span.begin)
      parameter.section = std::string(trim(std::string_view(comment.text).substr(1, comment.text.size() - 2)));
    if (comment.is_block) continue;
    const std::string_view before = trim(source.line(at)).substr(0, 2);
    if (at == line - 1 && before == "//") parameter.description = comment.text;
    if (at == last && comment.begin >= assign.span.end) read_widget(comment.text, parameter);
  }
}

}  // namespace

std::vector<Parameter> parameters_of(const SourcePtr& source) {
  Diagnostics ignored;
  const ast::File file = parse(source, ignored, Dialect::openscad);
  const Outline outline = outline_of(source->text());
  std::vector<Parameter> parameters;
  for (const ast::StatementPtr& statement : file.statements) {
    if (statement->kind != ast::Statement::Kind::assign) continue;
    const auto& assign = static_cast<const ast::Assign&>(*statement);
    if (assign.span.begin > outline.first_brace || assign.name.is_special()) continue;
    auto value = plain_value(*assign.value);
    if (!value) continue;
    value->where = assign.value->span.range();
    Parameter parameter;
    parameter.name = assign.name.text();
    parameter.kind = kind_of(*value);
    parameter.value = std::move(*value);
    read_comments(*source, outline, assign, parameter);
    const auto known = std::ranges::find(parameters, parameter.name, &Parameter::name);
    if (known != parameters.end())
      *known = std::move(parameter);
    else
      parameters.push_back(std::move(parameter));
  }
  return parameters;
}

Data to_data(const Parameter& parameter) {
  DataMembers members{
      {"name", parameter.name}, {"kind", kind_names[static_cast<size_t>(parameter.kind)]}, {"value", parameter.value}};
  if (!parameter.description.empty()) members.emplace_back("description", parameter.description);
  if (!parameter.section.empty()) members.emplace_back("section", parameter.section);
  if (parameter.least) members.emplace_back("least", *parameter.least);
  if (parameter.step) members.emplace_back("step", *parameter.step);
  if (parameter.most) members.emplace_back("most", *parameter.most);
  if (parameter.longest) members.emplace_back("longest", number(*parameter.longest));
  DataList choices;
  for (const auto& [value, label] : parameter.choices)
    choices.emplace_back(DataMembers{{"value", value}, {"label", label}});
  if (!choices.empty()) members.emplace_back("choices", std::move(choices));
  return members;
}

std::optional<std::vector<std::string>> parameter_set(const SourcePtr& file, const std::string& name,
                                                      const std::vector<Parameter>& parameters,
                                                      Diagnostics& diagnostics) {
  const auto data = parse_json(file, diagnostics);
  if (!data) return std::nullopt;
  const Data* sets = data->members() ? data->find("parameterSets") : nullptr;
  const Data* set = sets && sets->members() ? sets->find(name) : nullptr;
  if (!set || !set->members()) {
    std::vector<std::string> names;
    if (sets && sets->members())
      for (const auto& [known, members] : *sets->members()) names.push_back(known);
    diagnostics.error(Code::unknown_object, {file, 0, 0}, "there is no parameter set \"" + name + '"',
                      names.empty() ? "the file has none" : "the file has " + join(names, ", "),
                      {{"file", file->name()}, {"name", name}});
    return std::nullopt;
  }
  std::vector<std::string> definitions;
  for (const auto& [parameter, value] : *set->members()) {
    const auto known = std::ranges::find(parameters, parameter, &Parameter::name);
    if (known == parameters.end()) {
      diagnostics.warning(value.where, "the script has no parameter \"" + parameter + '"', "it is left out");
      continue;
    }
    const bool is_plain_text = known->value.string() && value.string();
    definitions.push_back(parameter + '=' +
                          (is_plain_text || !value.string() ? print_json_line(value) : *value.string()));
  }
  return definitions;
}

}  // namespace ombre::lang::openscad
