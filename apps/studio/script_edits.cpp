#include "studio/script_edits.h"

#include <cmath>

#include "base/text/file_ending.h"
#include "lang/edit/design_edit.h"
#include "lang/edit/graph_edit.h"
#include "lang/edit/json_layout.h"

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

// An item as the page sees it. The others of its members are added by those who describe it.
struct ItemPlace {
  std::string_view kind, callee, variable, locked_by;
  int line = 0;
  double from = 0, to = 0, at = 0;  // `at`: where the place of its node begins
};

DataMembers describe_item(const ItemPlace& place, DataList arguments, DataList wires) {
  return {{"kind", std::string(place.kind)},
          {"callee", std::string(place.callee)},
          {"variable", std::string(place.variable)},
          {"locked_by", std::string(place.locked_by)},
          {"line", number(place.line)},
          {"from", place.from},
          {"to", place.to},
          {"at", place.at},
          {"arguments", std::move(arguments)},
          {"wires", std::move(wires)}};
}

DataMembers describe_argument(const std::string& name, std::string text) {
  return {{"name", name}, {"text", std::move(text)}};
}

DataMembers describe_wire(size_t from, const std::string& output, size_t argument, bool is_whole) {
  return {{"from", number(from)}, {"output", output}, {"argument", number(argument)}, {"is_whole", is_whole}};
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
      arguments.emplace_back(describe_argument(argument.name, text(argument.value->span)));
    for (const lang::Mention* mention : wires_[number_of_item])
      wires.emplace_back(describe_wire(*mention->target, mention->output, mention->argument, mention->is_whole));
    const size_t at = one.expression ? one.expression->span.begin : one.span.begin;
    DataMembers members =
        describe_item({name_of(one.kind), one.callee, one.variable, one.locked_by, graph_.line(one.span),
                       offsets_.at(one.span.begin), offsets_.at(one.span.end), offsets_.at(at)},
                      std::move(arguments), std::move(wires));
    members.emplace_back("argument", number(one.argument));
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

// Describes the nodes and parts of a design file. Their inputs are lists, since several may take the same node.
class DesignDescriber {
 public:
  explicit DesignDescriber(const lang::DesignGraph& graph) : graph_(graph), offsets_(graph.text()) {
    wires_.resize(graph.items().size());
    for (const lang::DesignWire& wire : graph.wires())
      wires_[wire.item].emplace_back(describe_wire(wire.from, wire.output, wire.argument, wire.is_whole));
  }

  DataMembers describe() {
    DataList items;
    for (size_t n = 0; n < graph_.items().size(); ++n) items.emplace_back(item(n));
    return {{"items", std::move(items)}, {"definitions", DataList()}, {"is_cut", graph_.is_cut()}};
  }

 private:
  DataMembers item(size_t number_of_item) {
    const lang::DesignItem& one = graph_.items()[number_of_item];
    DataList arguments, inputs;
    for (const auto& [name, value] : one.arguments) {
      const lang::TextRange range = lang::JsonLayout(graph_.text()).whole(*value);
      arguments.emplace_back(
          describe_argument(name, std::string(graph_.text().substr(range.from, range.to - range.from))));
    }
    for (const size_t input : one.inputs) inputs.emplace_back(number(input));
    const SourceRange& where = one.object->where;
    // Nodes of the design have the place of their type.
    const Data* type = one.object->find("type");
    const size_t at = type ? type->where.begin : where.begin;
    DataMembers members =
        describe_item({one.is_part ? "part" : "node", one.type, one.name, "", graph_.source()->place(where.begin).line,
                       offsets_.at(where.begin), offsets_.at(where.end), offsets_.at(at)},
                      std::move(arguments), std::move(wires_[number_of_item]));
    members.emplace_back("inputs", std::move(inputs));
    return members;
  }

  const lang::DesignGraph& graph_;
  PageOffsets offsets_;
  std::vector<DataList> wires_;
};

bool is_design_file(const SourcePtr& source) { return ending_of(source->name()) == ".json"; }

Answer graph_of(const SourcePtr& source) {
  Diagnostics diagnostics;
  Answer answer;
  const auto describe_graph = [&](auto graph, auto describe) {
    if (graph) answer.members = describe(*graph).describe();
    answer.members.emplace_back("ok", graph.has_value());
  };
  if (is_design_file(source))
    describe_graph(lang::DesignGraph::read(source, diagnostics),
                   [](const lang::DesignGraph& graph) { return DesignDescriber(graph); });
  else
    describe_graph(ScriptGraph::read(source, dialect_of(source->name()), diagnostics),
                   [](const ScriptGraph& graph) { return GraphDescriber(graph); });
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

std::optional<lang::EditedScript> edited_text(const SourcePtr& source, const GraphEdit& edit,
                                              Diagnostics& diagnostics) {
  if (is_design_file(source)) return lang::edit_design(source, edit, diagnostics);
  return lang::edit(source, dialect_of(source->name()), edit, diagnostics);
}

Answer refusal(const Diagnostics& diagnostics, const SourcePtr& source) {
  return {{{"ok", false}, {"diagnostics", describe(diagnostics, source)}}, {}};
}

}  // namespace

Answer script_graph_answer(const Workspace&, const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  return graph_of(make_source(file, request.text("text")));
}

Answer edit_graph_answer(const Workspace&, const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  SourcePtr source = make_source(file, request.text("text"));
  std::string text(source->text());
  DataList steps;
  Diagnostics diagnostics;
  if (const std::string library = request.text("library", ""); !library.empty()) {
    const auto used = edited_text(source, lang::UseLibrary{library}, diagnostics);
    if (!used) return refusal(diagnostics, source);
    describe_steps(used->steps, text, steps);
    source = used->text;
  }
  const auto edited = edited_text(source, edit_in(request), diagnostics);
  if (!edited) return refusal(diagnostics, source);
  describe_steps(edited->steps, text, steps);
  Answer answer = graph_of(edited->text);
  answer.members.emplace_back("steps", std::move(steps));
  if (!edited->library.empty()) answer.members.emplace_back("library", edited->library);
  if (edited->made) answer.members.emplace_back("made", PageOffsets(text).at(*edited->made));
  return answer;
}

}  // namespace ombre::studio
