#include "lang/vcad/equal_nodes.h"

#include <utility>

#include "design/outputs.h"
#include "design/registry.h"

namespace ombre::lang {

using design::NodePtr;
using design::NodeType;

namespace {

constexpr size_t most_in_table = 3 << 14;  // three quarters of the slots are in use then

template <class T>
void append_bytes(std::string& key, const T& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Returns an identity that is equal for outputs of the same node.
uintptr_t identity(const HostObject& object) {
  const auto* output = dynamic_cast<const design::NodeObject*>(&object);
  return output ? reinterpret_cast<uintptr_t>(output->node().get()) : reinterpret_cast<uintptr_t>(&object);
}

// Appends bytes that are equal only for equal values.
void append_value(std::string& key, const Data& data) {
  key += static_cast<char>(data.value.index());
  if (const bool* b = data.boolean()) key += *b ? '1' : '0';
  if (const double* n = data.number()) append_bytes(key, *n == 0 ? 0.0 : *n);
  if (const std::string* s = data.string()) {
    append_bytes(key, s->size());
    key += *s;
  }
  if (const DataList* list = data.list()) {
    append_bytes(key, list->size());
    for (const Data& element : *list) append_value(key, element);
  }
  if (const DataMembers* members = data.members()) {
    append_bytes(key, members->size());
    for (const auto& [name, member] : *members) {
      append_value(key, Data(name));
      append_value(key, member);
    }
  }
  if (const HostObjectPtr object = data.host_object()) append_bytes(key, identity(*object));
}

}  // namespace

NodePtr EqualNodes::first(NodePtr node) {
  if (!node) return node;
  const NodeType* type = &node->type();
  key_.clear();
  append_bytes(key_, reinterpret_cast<uintptr_t>(type));
  for (size_t i = 0; i < type->parameters.size(); ++i) append_value(key_, type->get(*node, i, false));
  for (const NodePtr& input : node->inputs()) append_bytes(key_, reinterpret_cast<uintptr_t>(input.get()));

  const Hash hash = hash_bytes(key_);
  if (NodePtr known = latest_.find(hash)) return known;
  if (NodePtr known = older_.find(hash)) node = std::move(known);
  if (latest_.count == most_in_table) older_ = std::exchange(latest_, {});
  latest_.add(hash, node);
  return node;
}

NodePtr EqualNodes::Table::find(const Hash& hash) const { return slots.empty() ? nullptr : slots[place(hash)].node; }

void EqualNodes::Table::add(const Hash& hash, NodePtr node) {
  if (4 * count >= 3 * slots.size()) widen();
  slots[place(hash)] = {hash, std::move(node)};
  ++count;
}

size_t EqualNodes::Table::place(const Hash& hash) const {
  const size_t mask = slots.size() - 1;
  size_t at = hash.low & mask;
  while (slots[at].node && slots[at].hash != hash) at = (at + 1) & mask;
  return at;
}

void EqualNodes::Table::widen() {
  constexpr size_t least = 64;
  std::vector<Slot> narrow(std::max(least, 2 * slots.size()));
  narrow.swap(slots);
  for (Slot& slot : narrow)
    if (slot.node) slots[place(slot.hash)] = std::move(slot);
}

}  // namespace ombre::lang
