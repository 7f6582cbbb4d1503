#include "lang/vocabulary/equal_nodes.h"

#include "base/assert.h"
#include "design/registry.h"

namespace ombre::lang {

using design::NodePtr;
using design::NodeType;

namespace {

template <class T>
void append_bytes(std::string& key, const T& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Bytes that are the same for equal values only.
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
  if (const HostObjectPtr object = data.host_object()) append_bytes(key, reinterpret_cast<uintptr_t>(object.get()));
  ASSERT(!data.members() && "no parameter has members");
}

}  // namespace

NodePtr EqualNodes::first(NodePtr node) {
  if (!node) return node;
  const NodeType* type = &node->type();
  key_.clear();
  append_bytes(key_, reinterpret_cast<uintptr_t>(type));
  for (size_t i = 0; i < type->parameters.size(); ++i) append_value(key_, type->get(*node, i, false));
  for (const NodePtr& input : node->inputs()) append_bytes(key_, reinterpret_cast<uintptr_t>(input.get()));

  if (4 * count_ >= 3 * slots_.size()) widen();
  const Hash hash = hash_bytes(key_);
  Slot& slot = slot_of(slots_, hash);
  if (!slot.node) {
    slot = {hash, std::move(node)};
    ++count_;
  }
  return slot.node;
}

// The slot with that hash, or the free one that it would get.
EqualNodes::Slot& EqualNodes::slot_of(std::vector<Slot>& slots, const Hash& hash) {
  const size_t mask = slots.size() - 1;
  size_t at = hash.low & mask;
  while (slots[at].node && slots[at].hash != hash) at = (at + 1) & mask;
  return slots[at];
}

void EqualNodes::widen() {
  constexpr size_t least = 64;
  std::vector<Slot> wide(std::max(least, 2 * slots_.size()));
  for (Slot& slot : slots_)
    if (slot.node) slot_of(wide, slot.hash) = std::move(slot);
  slots_ = std::move(wide);
}

}  // namespace ombre::lang
