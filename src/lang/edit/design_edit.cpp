#include "lang/edit/design_edit.h"

#include <algorithm>

#include "base/text/json.h"
#include "base/text/text.h"
#include "lang/edit/edit_steps.h"
#include "lang/edit/json_layout.h"

namespace ombre::lang {
namespace {

// Makes an edit, in one or more steps. After each step the graph is read again, so that what lasts longer than a step
// is named by ids.
class DesignRun : public EditSteps<DesignGraph> {
 public:
  using EditSteps::EditSteps;

  void run(const SetArgument& edit);
  void run(const InsertCall& edit);
  void run(const AddVariable& edit);
  void run(const RemoveItem& edit);
  void run(const ConnectItems& edit);
  void run(const RenameVariable& edit);
  void run(const MoveCall& edit);
  void run(const GroupCalls&) { refuse({}, "a design file has no modules", "write the design as a script"); }
  void run(const UseLibrary&) { refuse({}, "a design file uses no libraries", "write the design as a script"); }
  void run(const MoveToLibrary&) { refuse({}, "a design file has no modules", "write the design as a script"); }

 private:
  [[noreturn]] void refuse(const SourceRange& where, const std::string& message, Phrase hint = {}) const {
    refuse_at(where, message, std::move(hint));
  }
  const DesignItem& item(size_t number) const;
  const DesignItem& node(size_t number) const;  // refuses parts
  const DesignItem& called(const std::string& id) const { return graph_.items()[*graph_.node_called(id)]; }
  JsonLayout layout() const { return JsonLayout(graph_.text()); }
  std::string line_of(const DesignItem& of) const;

  std::string checked_json(const std::string& value) const;
  std::string checked_new_id(const std::string& name) const;
  std::string free_id() const;
  std::string free_part() const;

  // The nodes and parts that take a node, by their numbers; a node that takes it twice is there twice.
  std::vector<size_t> users_of(const std::string& id) const;
  void refuse_last_part(const DesignItem& part) const;

  // Return the id of the new node.
  std::string add_node(const std::string& call, const std::vector<std::string>& inputs);
  std::string add_node(const std::string& id, const std::string& call, const std::vector<std::string>& inputs);
  void note_made(const std::string& id) { result_.made = called(id).object->where.begin; }
  void add_part(const std::string& id);
  void add_input(const std::string& of, size_t index, const std::string& id);
  void remove_entry(const Data& list, const Data* entry);
  // Takes a node out of the inputs of others; `others` take its place.
  void replace_uses(const std::string& id, const std::vector<std::string>& others, const std::string& except = "");
  void remove_node(const std::string& id);
  void remove_unused(const std::vector<std::string>& ids);
  void need_version_of_values();
};

const DesignItem& DesignRun::item(size_t number) const {
  if (number >= graph_.items().size()) refuse({}, "the file has no node with the number " + std::to_string(number));
  const DesignItem& found = graph_.items()[number];
  const char* name = found.is_part ? "name" : "id";
  if (!found.object->find(name) || !found.object->find(name)->string())
    refuse(found.object->where, std::string("this has no \"") + name + "\", a text", "edit the text");
  if (!found.is_part && graph_.node_called(found.name) != number)
    refuse(found.object->where, "two nodes have the id \"" + found.name + '"', "edit the text");
  return found;
}

const DesignItem& DesignRun::node(size_t number) const {
  const DesignItem& found = item(number);
  if (found.is_part)
    refuse(found.object->where, "\"" + found.name + "\" is a part, which has one node and no parameters");
  return found;
}

std::string DesignRun::line_of(const DesignItem& of) const {
  return "line " + std::to_string(graph_.source()->place(of.object->where.begin).line);
}

std::string DesignRun::checked_json(const std::string& value) const {
  const std::string text(trim(value));
  Diagnostics mistakes;
  if (!parse_json(make_source("", text), mistakes) || mistakes.has_errors())
    refuse({}, '"' + text + "\" is no value", R"(write JSON, for example 5, [1, 2, 3] or "red")");
  return text;
}

std::string DesignRun::checked_new_id(const std::string& name) const {
  std::string id(trim(name));
  if (id.empty()) refuse({}, "a name is not empty");
  if (const auto other = graph_.node_called(id))
    refuse(graph_.items()[*other].object->where,
           '"' + id + "\" is there already, in " + line_of(graph_.items()[*other]), "choose another name");
  return id;
}

std::string DesignRun::free_id() const {
  for (size_t n = graph_.items().size() - graph_.part_count() + 1;; ++n)
    if (std::string id = "n" + std::to_string(n); !graph_.node_called(id)) return id;
}

std::string DesignRun::free_part() const {
  const auto is_free = [&](const std::string& name) {
    return std::ranges::none_of(graph_.items(), [&](const DesignItem& one) { return one.is_part && one.name == name; });
  };
  std::string name = "part";
  for (int n = 2; !is_free(name); ++n) name = "part" + std::to_string(n);
  return name;
}

std::vector<size_t> DesignRun::users_of(const std::string& id) const {
  const size_t node = *graph_.node_called(id);
  std::vector<size_t> users;
  for (size_t n = 0; n < graph_.items().size(); ++n)
    for (const size_t input : graph_.items()[n].inputs)
      if (input == node) users.push_back(n);
  return users;
}

void DesignRun::refuse_last_part(const DesignItem& part) const {
  if (graph_.part_count() == 1) refuse(part.object->where, "the design would have no part", "add another one first");
}

void DesignRun::run(const SetArgument& edit) {
  const DesignItem& of = node(edit.item);
  if (edit.index && *edit.index >= of.arguments.size())
    refuse(of.object->where, "this node has no parameter with the number " + std::to_string(*edit.index));
  const Data* parameters = of.object->find("parameters");
  if (trim(edit.value).empty()) {
    if (edit.index) commit({layout().removed(*parameters, *edit.index)});
    return;
  }
  const std::string value = checked_json(edit.value);
  if (edit.index) {
    const Replacement change = layout().replaced(*of.arguments[*edit.index].second, value);
    if (graph_.text().substr(change.from, change.to - change.from) != value) commit({change});
    return;
  }
  if (std::ranges::find(of.arguments, edit.name, [](const auto& one) { return one.first; }) != of.arguments.end())
    refuse(of.object->where, '"' + edit.name + "\" has a value already");
  const std::string member = quoted(edit.name) + ": " + value;
  if (!parameters) {
    const auto& members = *of.object->members();
    const auto type = std::ranges::find(members, "type", [](const auto& one) { return one.first; });
    return commit({layout().added(*of.object, static_cast<size_t>(type - members.begin()) + 1,
                                  R"("parameters": {)" + member + '}')});
  }
  if (!parameters->members()) refuse(parameters->where, "the parameters of a node are an object", "edit the text");
  commit({layout().added(*parameters, of.arguments.size(), member)});
}

std::string DesignRun::add_node(const std::string& call, const std::vector<std::string>& inputs) {
  return add_node(free_id(), call, inputs);
}

std::string DesignRun::add_node(const std::string& id, const std::string& call,
                                const std::vector<std::string>& inputs) {
  std::string_view wanted = trim(call);
  std::string type(wanted), parameters;
  Diagnostics mistakes;
  const SourcePtr source = make_source("", std::string(wanted));
  if (const auto data = parse_json(source, mistakes); data && data->members()) {
    const Data *name = data->find("type"), *values = data->find("parameters");
    if (!name || !name->string() || (values && !values->members()))
      refuse({}, "a new node has a type and parameters",
             R"(write for example {"type": "sphere", "parameters": {"radius": 5}})");
    type = *name->string();
    const auto text = [&](const Data& value) {
      return source->text().substr(value.where.begin, value.where.end - value.where.begin);
    };
    if (values && !values->members()->empty()) parameters = R"(, "parameters": )" + std::string(text(*values));
  }
  const auto is_word = [](char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  if (type.empty() || !std::ranges::all_of(type, is_word))
    refuse({}, '"' + type + "\" is no type of nodes", "write for example sphere");
  std::vector<std::string> ids;
  for (const std::string& input : inputs) ids.push_back(quoted(input));
  const std::string list = inputs.empty() ? "" : R"(, "inputs": [)" + join(ids, ", ") + ']';
  const std::string entry = R"({"id": )" + quoted(id) + R"(, "type": )" + quoted(type) + parameters + list + '}';
  commit({layout().added(graph_.nodes(), graph_.nodes().list()->size(), entry)});
  return id;
}

void DesignRun::add_part(const std::string& id) {
  const std::string entry = R"({"name": )" + quoted(free_part()) + R"(, "node": )" + quoted(id) + '}';
  commit({layout().added(graph_.parts(), graph_.part_count(), entry)});
}

void DesignRun::add_input(const std::string& of, size_t index, const std::string& id) {
  const Data& object = *called(of).object;
  const Data* inputs = object.find("inputs");
  if (!inputs) return commit({layout().added(object, object.members()->size(), R"("inputs": [)" + quoted(id) + ']')});
  if (!inputs->list()) refuse(inputs->where, "the inputs of a node are a list", "edit the text");
  commit({layout().added(*inputs, index, quoted(id))});
}

void DesignRun::run(const InsertCall& edit) {
  using Where = InsertCall::Where;
  std::string made;
  if (edit.where == Where::end) {
    made = add_node(edit.call, {});
    add_part(made);
    return note_made(made);
  }
  const DesignItem& at = item(edit.item);
  if (at.is_part && (at.inputs.empty() || edit.where != Where::around))
    refuse(at.object->where, '"' + at.name + "\" is a part, which has one node", "put it around that, or at the end");
  const std::string id = at.is_part ? graph_.items()[at.inputs.front()].name : at.name;
  if (edit.where == Where::around) {
    made = add_node(edit.call, {id});
    replace_uses(id, {made}, made);
  } else if (edit.where == Where::inside) {
    made = add_node(edit.call, {});
    add_input(id, SIZE_MAX, made);
  } else {
    made = add_node(edit.call, {});
    const std::vector<size_t> users = users_of(id);
    const auto user = std::ranges::find_if(users, [&](size_t n) { return !graph_.items()[n].is_part; });
    if (user == users.end()) {
      add_part(made);
    } else {
      const DesignItem& taker = graph_.items()[*user];
      const auto& inputs = *taker.object->find("inputs")->list();
      const auto place = std::ranges::find(inputs, Data(id)) - inputs.begin();
      add_input(std::string(taker.name), static_cast<size_t>(place) + 1, made);
    }
  }
  note_made(made);
}

void DesignRun::run(const AddVariable& edit) {
  const std::string id = checked_new_id(edit.name);
  add_node(id, edit.value, {});
  note_made(id);
}

void DesignRun::remove_entry(const Data& list, const Data* entry) {
  const auto& entries = *list.list();
  const auto found = std::ranges::find_if(entries, [&](const Data& one) { return &one == entry; });
  commit({layout().removed(list, static_cast<size_t>(found - entries.begin()))});
}

void DesignRun::replace_uses(const std::string& id, const std::vector<std::string>& others, const std::string& except) {
  std::vector<std::string> ids;
  for (const std::string& other : others) ids.push_back(quoted(other));
  // A use is changed in each step.
  for (;;) {
    Replacements step;
    for (const size_t number : users_of(id)) {
      const DesignItem& user = graph_.items()[number];
      if (user.name == except && !user.is_part) continue;
      if (user.is_part) {
        step = {layout().replaced(*user.object->find("node"), ids.front())};
      } else {
        const Data& inputs = *user.object->find("inputs");
        const auto place = static_cast<size_t>(std::ranges::find(*inputs.list(), Data(id)) - inputs.list()->begin());
        step = {ids.empty() ? layout().removed(inputs, place)
                            : layout().replaced((*inputs.list())[place], join(ids, ", "))};
      }
      break;
    }
    if (step.empty()) return;
    commit(std::move(step));
  }
}

void DesignRun::remove_node(const std::string& id) { remove_entry(graph_.nodes(), called(id).object); }

// Removes those of the nodes that nothing uses, and so on below them.
void DesignRun::remove_unused(const std::vector<std::string>& ids) {
  std::vector<std::string> left = ids;
  while (!left.empty()) {
    const std::string id = left.back();
    left.pop_back();
    const auto number = graph_.node_called(id);
    if (!number || !users_of(id).empty()) continue;
    if (std::ranges::find(graph_.wires(), *number, &DesignWire::from) != graph_.wires().end()) continue;
    for (const size_t input : graph_.items()[*number].inputs) left.push_back(graph_.items()[input].name);
    remove_node(id);
  }
}

void DesignRun::run(const RemoveItem& edit) {
  const DesignItem& removed = item(edit.item);
  std::vector<std::string> below;
  for (const size_t input : removed.inputs) below.push_back(graph_.items()[input].name);
  if (removed.is_part) {
    refuse_last_part(removed);
    remove_entry(graph_.parts(), removed.object);
    return remove_unused(below);
  }
  const std::string id = removed.name;
  for (const DesignWire& wire : graph_.wires())
    if (wire.from == edit.item)
      refuse(wire.id->where, '"' + id + "\" is used in " + line_of(graph_.items()[wire.item]), "disconnect it first");
  const std::vector<size_t> users = users_of(id);
  const bool is_a_part = std::ranges::any_of(users, [&](size_t user) { return graph_.items()[user].is_part; });
  if (edit.keeps_children && is_a_part && below.size() > 1)
    refuse(removed.object->where, "a part has one node, and this one takes " + std::to_string(below.size()),
           "remove it with them");
  const bool keeps = edit.keeps_children && !below.empty();
  if (is_a_part && !keeps) {
    std::vector<size_t> parts;
    for (const size_t user : users)
      if (graph_.items()[user].is_part) parts.push_back(user);
    if (parts.size() == graph_.part_count())
      refuse(removed.object->where, "the design would have no part", "add another one first");
    std::ranges::reverse(parts);  // the numbers of those before one that is removed stay
    for (const size_t part : parts) remove_entry(graph_.parts(), graph_.items()[part].object);
  }
  replace_uses(id, keeps ? below : std::vector<std::string>());
  remove_node(id);
  if (!edit.keeps_children) remove_unused(below);
}

void DesignRun::need_version_of_values() {
  const Data* version = graph_.root().find("version");
  if (version && version->number() && *version->number() == 1) commit({layout().replaced(*version, "2")});
}

void DesignRun::run(const ConnectItems& edit) {
  const std::string from = node(edit.from).name;
  const DesignItem& to = node(edit.to.item);
  if (graph_.needs(edit.from, edit.to.item)) refuse(to.object->where, "a value cannot depend on itself");
  SetArgument set = edit.to;
  const std::string output = edit.output.empty() ? "" : R"(, "output": )" + quoted(edit.output);
  set.value = R"({"from": )" + quoted(from) + output + '}';
  need_version_of_values();
  run(set);
}

void DesignRun::run(const RenameVariable& edit) {
  const DesignItem& renamed = item(edit.item);
  const std::string name(trim(edit.name));
  if (name == renamed.name) return;
  Replacements step;
  const auto rename = [&](const Data* text) { step.push_back(layout().replaced(*text, quoted(name))); };
  if (renamed.is_part) {
    if (name.empty()) refuse({}, "a name is not empty");
    for (size_t n = 0; n < graph_.part_count(); ++n)
      if (graph_.items()[n].name == name)
        refuse(graph_.items()[n].object->where, "there is a part \"" + name + "\" already", "choose another name");
    rename(renamed.object->find("name"));
    return commit(std::move(step));
  }
  checked_new_id(name);
  rename(renamed.object->find("id"));
  for (const DesignItem& other : graph_.items()) {
    const Data* uses = other.object->find(other.is_part ? "node" : "inputs");
    if (!uses) continue;
    if (*uses == Data(renamed.name)) rename(uses);
    if (uses->list())
      for (const Data& use : *uses->list())
        if (use == Data(renamed.name)) rename(&use);
  }
  for (const DesignWire& wire : graph_.wires())
    if (wire.from == edit.item) rename(wire.id);
  commit(std::move(step));
}

void DesignRun::run(const MoveCall& edit) {
  const std::string id = node(edit.item).name;
  const std::vector<size_t> users = users_of(id);
  const bool is_part = std::ranges::any_of(users, [&](size_t user) { return graph_.items()[user].is_part; });
  if (!edit.into && is_part) return;
  std::string into;
  if (edit.into) {
    into = node(*edit.into).name;
    if (graph_.needs(edit.item, *edit.into)) refuse(item(edit.item).object->where, "a node cannot be within itself");
  }
  // A node that others take as well stays with them.
  if (users.size() == 1) {
    const DesignItem& user = graph_.items()[users.front()];
    if (user.is_part) {
      refuse_last_part(user);
      remove_entry(graph_.parts(), user.object);
    } else {
      replace_uses(id, {});
    }
  }
  if (edit.into)
    add_input(into, SIZE_MAX, id);
  else
    add_part(id);
}

}  // namespace

std::optional<EditedScript> edit_design(const SourcePtr& file, const GraphEdit& edit, Diagnostics& diagnostics) {
  return make_edit<DesignRun>(DesignGraph::read(file, diagnostics), edit, diagnostics);
}

}  // namespace ombre::lang
