#include "lang/edit/design_graph.h"

#include <algorithm>
#include <functional>

#include "base/text/json.h"

namespace ombre::lang {
namespace {

bool has_list(const Data& data, const char* name) {
  const Data* found = data.find(name);
  return found && found->list();
}

std::string text_in(const Data& data, std::string_view name) {
  const Data* found = data.find(name);
  return found && found->string() ? *found->string() : "";
}

// Calls `found` for each object with a reference to a node in a parameter's value.
void find_references(const Data& value, const std::function<void(const Data& object, const Data& id)>& found) {
  if (const DataList* list = value.list())
    for (const Data& element : *list) find_references(element, found);
  if (!value.members()) return;
  for (const auto& [key, member] : *value.members()) {
    if (key == "from" && member.string()) found(value, member);
    find_references(member, found);
  }
}

}  // namespace

std::optional<DesignGraph> DesignGraph::read(const SourcePtr& source, Diagnostics& diagnostics) {
  const size_t errors_before = diagnostics.error_count();
  auto root = parse_json(source, diagnostics);
  if (!root || diagnostics.error_count() > errors_before) return std::nullopt;
  if (!root->members() || !has_list(*root, "nodes") || !has_list(*root, "parts")) {
    diagnostics.error(Code::design_file, root->where, "this is not a design file: it lacks the lists of nodes or parts",
                      R"(expected {"format": "ombre-design", "version": 2, "nodes": [...], "parts": [...]})");
    return std::nullopt;
  }
  DesignGraph graph;
  graph.source_ = source;
  graph.root_ = std::make_unique<const Data>(std::move(*root));
  graph.add_parts();
  graph.add_nodes();
  for (size_t item = 0; item < graph.items_.size(); ++item) graph.connect(item);
  return graph;
}

void DesignGraph::add_parts() {
  for (const Data& entry : *parts().list()) {
    DesignItem part;
    part.is_part = true;
    part.name = text_in(entry, "name");
    part.object = &entry;
    items_.push_back(std::move(part));
  }
  part_count_ = items_.size();
}

void DesignGraph::add_nodes() {
  for (const Data& entry : *nodes().list()) {
    if (items_.size() >= most_items) {
      is_cut_ = true;
      return;
    }
    DesignItem node;
    node.name = text_in(entry, "id");
    node.type = text_in(entry, "type");
    node.object = &entry;
    const Data* parameters = entry.find("parameters");
    if (parameters && parameters->members())
      for (const auto& [name, value] : *parameters->members()) node.arguments.emplace_back(name, &value);
    items_.push_back(std::move(node));
  }
}

void DesignGraph::connect(size_t number) {
  DesignItem& item = items_[number];
  const auto add_input = [&](const Data& id) {
    const auto node = id.string() ? node_called(*id.string()) : std::nullopt;
    if (node) item.inputs.push_back(*node);
  };
  if (item.is_part) {
    if (const Data* node = item.object->find("node")) add_input(*node);
    return;
  }
  const Data* inputs = item.object->find("inputs");
  if (inputs && inputs->list())
    for (const Data& id : *inputs->list()) add_input(id);
  for (size_t n = 0; n < item.arguments.size(); ++n)
    find_references(*item.arguments[n].second, [&](const Data& object, const Data& id) {
      const auto from = node_called(*id.string());
      if (from)
        wires_.push_back({number, n, *from, text_in(object, "output"), &id, &object == item.arguments[n].second});
    });
}

std::optional<size_t> DesignGraph::node_called(std::string_view id) const {
  for (size_t n = part_count_; n < items_.size(); ++n)
    if (items_[n].name == id) return n;
  return std::nullopt;
}

bool DesignGraph::needs(size_t item, size_t other) const {
  std::vector<size_t> found{item};
  const auto add = [&](size_t number) {
    if (std::ranges::find(found, number) == found.end()) found.push_back(number);
  };
  size_t next = 0;
  while (next < found.size()) {
    const size_t at = found[next++];
    if (at == other) return true;
    for (const size_t input : items_[at].inputs) add(input);
    for (const DesignWire& wire : wires_)
      if (wire.item == at) add(wire.from);
  }
  return false;
}

}  // namespace ombre::lang
