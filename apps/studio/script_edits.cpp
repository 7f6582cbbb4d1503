#include "studio/script_edits.h"

#include <cmath>

#include "base/text/file_ending.h"
#include "lang/edit/graph_edit.h"

namespace ombre::studio {
namespace {

using lang::GraphEdit;
using lang::GraphItem;
using lang::ScriptGraph;

lang::Dialect dialect_of(const std::string& file) {
  return ending_of(file) == ".scad" ? lang::Dialect::openscad : lang::Dialect::vcad;
}

std::string_view name_of(GraphItem::Kind kind) {
  switch (kind) {
    case GraphItem::Kind::call:
      return "call";
    case GraphItem::Kind::variable:
      return "variable";
    case GraphItem::Kind::value:
      return "value";
    case GraphItem::Kind::group:
      break;
  }
  return "group";
}

class GraphDescriber {
 public:
  explicit GraphDescriber(const ScriptGraph& graph) : graph_(graph), offsets_(graph.text()) {
    wires_.resize(graph.items().size());
    for (const lang::Mention& mention : graph.mentions())
      if (mention.target && mention.item != ScriptGraph::no_item) wires_[mention.item].push_back(&mention);
  }

  DataMembers describe() const {
    DataList items, definitions;
    for (size_t n = 0; n < graph_.items().size(); ++n) items.emplace_back(item(n));
    for (const lang::GraphDefinition& one : graph_.definitions()) definitions.emplace_back(definition(one));
    return {{"items", std::move(items)}, {"definitions", std::move(definitions)}, {"is_cut", graph_.is_cut()}};
  }

 private:
  std::string text(const lang::ast::Span& span) const { return std::string(graph_.text(span)); }

  DataMembers item(size_t number_of_item) const {
    const GraphItem& one = graph_.items()[number_of_item];
    DataList arguments, wires;
    for (const lang::GraphArgument& argument : one.arguments)
      arguments.emplace_back(DataMembers{{"name", argument.name}, {"text", text(argument.value->span)}});
    for (const lang::Mention* mention : wires_[number_of_item])
      wires.emplace_back(DataMembers{{"from", number(*mention->target)},
                                     {"output", mention->output},
                                     {"argument", number(mention->argument)},
                                     {"is_whole", mention->is_whole}});
    DataMembers members{{"kind", std::string(name_of(one.kind))},
                        {"callee", one.callee},
                        {"variable", one.variable},
                        {"argument", number(one.argument)},
                        {"locked_by", one.locked_by},
                        {"line", number(graph_.line(one.span))},
                        {"from", offsets_.at(one.span.begin)},
                        {"to", offsets_.at(one.span.end)},
                        {"at", offsets_.at(one.expression ? one.expression->span.begin : one.span.begin)},
                        {"arguments", std::move(arguments)},
                        {"wires", std::move(wires)}};
    if (one.parent) members.emplace_back("parent", number(*one.parent));
    return members;
  }

  DataMembers definition(const lang::GraphDefinition& one) const {
    DataList parameters;
    for (const lang::ast::Parameter& parameter : *one.parameters)
      parameters.emplace_back(DataMembers{{"name", parameter.name.text()},
                                          {"default", parameter.value ? text(parameter.value->span) : std::string()}});
    return {{"name", one.name},
            {"is_module", one.is_module},
            {"line", number(graph_.line(one.span))},
            {"parameters", std::move(parameters)}};
  }

  const ScriptGraph& graph_;
  PageOffsets offsets_;
  std::vector<std::vector<const lang::Mention*>> wires_;
};

Answer graph_of(const SourcePtr& source, lang::Dialect dialect) {
  Diagnostics diagnostics;
  const auto graph = ScriptGraph::read(source, dialect, diagnostics);
  Answer answer;
  if (graph) answer.members = GraphDescriber(*graph).describe();
  answer.members.emplace_back("ok", graph.has_value());
  answer.members.emplace_back("diagnostics", describe(diagnostics, source));
  return answer;
}

size_t item_in(const Request& request, std::string_view member) {
  return static_cast<size_t>(request.whole(member, 0, ScriptGraph::most_items));
}

std::optional<size_t> item_or_none(const Request& request, std::string_view member) {
  return request.body.find(member) ? std::optional(item_in(request, member)) : std::nullopt;
}

std::vector<size_t> items_in(const Request& request, std::string_view member) {
  const Data* found = request.body.find(member);
  if (!found) return {};
  std::vector<size_t> items;
  for (const double item : request.numbers(member, found->list() ? found->list()->size() : 0)) {
    if (item < 0 || item > ScriptGraph::most_items || item != std::floor(item))
      throw RequestError("request", '"' + std::string(member) + "\" has whole numbers");
    items.push_back(static_cast<size_t>(item));
  }
  return items;
}

lang::SetArgument set_argument(const Request& request) {
  return {item_in(request, "item"), item_or_none(request, "index"), request.text("name", ""),
          request.text("value", "")};
}

lang::InsertCall insert_call(const Request& request) {
  using Where = lang::InsertCall::Where;
  const std::string& where = request.text("where");
  const std::string& call = request.text("call");
  if (where == "end") return {Where::end, 0, call};
  if (where == "inside") return {Where::inside, item_in(request, "item"), call};
  if (where == "after") return {Where::after, item_in(request, "item"), call};
  if (where == "around") return {Where::around, item_in(request, "item"), call};
  throw RequestError("request", "\"where\" is end, inside, after or around");
}

lang::GroupCalls group_calls(const Request& request) {
  lang::GroupCalls group;
  const std::vector<size_t> of = items_in(request, "parameter_items");
  const std::vector<size_t> arguments = items_in(request, "parameter_arguments");
  const std::vector<std::string> names = request.texts("parameter_names");
  if (of.size() != names.size() || arguments.size() != names.size())
    throw RequestError("request", "each parameter has an item, an argument and a name");
  for (size_t n = 0; n < names.size(); ++n) group.parameters.push_back({of[n], arguments[n], names[n]});
  group.items = items_in(request, "items");
  group.name = request.text("name");
  group.sentence = request.text("sentence", "");
  return group;
}

GraphEdit edit_in(const Request& request) {
  const std::string& kind = request.text("edit");
  if (kind == "set") return set_argument(request);
  if (kind == "insert") return insert_call(request);
  if (kind == "variable") return lang::AddVariable{request.text("name"), request.text("value")};
  if (kind == "remove") return lang::RemoveItem{item_in(request, "item"), request.flag("keeps_children")};
  if (kind == "connect")
    return lang::ConnectItems{item_in(request, "source"), request.text("output", ""), set_argument(request)};
  if (kind == "rename") return lang::RenameVariable{item_in(request, "item"), request.text("name")};
  if (kind == "move") return lang::MoveCall{item_in(request, "item"), item_or_none(request, "into")};
  if (kind == "group") return group_calls(request);
  if (kind == "library")
    return lang::MoveToLibrary{request.text("module"), request.text("path"), request.text("sentence", "")};
  throw RequestError("request", "\"edit\" is set, insert, variable, remove, connect, rename, move, group or library");
}

// Adds the steps, with places as the page counts them. Returns the text after them.
void describe_steps(const std::vector<lang::Replacements>& steps, std::string& text, DataList& into) {
  for (const lang::Replacements& step : steps) {
    const PageOffsets offsets(text);
    DataList list;
    for (const lang::Replacement& one : step)
      list.emplace_back(DataMembers{{"from", offsets.at(one.from)}, {"to", offsets.at(one.to)}, {"insert", one.text}});
    into.emplace_back(std::move(list));
    text = lang::applied(text, step);
  }
}

Answer refusal(const Diagnostics& diagnostics, const SourcePtr& source) {
  return {{{"ok", false}, {"diagnostics", describe(diagnostics, source)}}, {}};
}

}  // namespace

Answer script_graph_answer(const Workspace&, const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  return graph_of(make_source(file, request.text("text")), dialect_of(file));
}

Answer edit_graph_answer(const Workspace&, const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  const lang::Dialect dialect = dialect_of(file);
  SourcePtr source = make_source(file, request.text("text"));
  std::string text(source->text());
  DataList steps;
  Diagnostics diagnostics;
  if (const std::string library = request.text("library", ""); !library.empty()) {
    const auto used = lang::edit(source, dialect, lang::UseLibrary{library}, diagnostics);
    if (!used) return refusal(diagnostics, source);
    describe_steps(used->steps, text, steps);
    source = used->text;
  }
  const auto edited = lang::edit(source, dialect, edit_in(request), diagnostics);
  if (!edited) return refusal(diagnostics, source);
  describe_steps(edited->steps, text, steps);
  Answer answer = graph_of(edited->text, dialect);
  answer.members.emplace_back("steps", std::move(steps));
  if (!edited->library.empty()) answer.members.emplace_back("library", edited->library);
  if (edited->made) answer.members.emplace_back("made", PageOffsets(text).at(*edited->made));
  return answer;
}

}  // namespace ombre::studio
