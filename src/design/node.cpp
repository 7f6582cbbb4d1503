#include "design/node.h"

#include <algorithm>
#include <new>
#include <unordered_set>

namespace ombre::design {

void Node::finish(std::vector<NodePtr> inputs, const std::vector<NodePtr>& values, SourceRange where) {
  where_ = std::move(where);
  input_count_ = static_cast<uint32_t>(inputs.size());
  value_count_ = static_cast<uint16_t>(values.size());
  if (input_count_ + value_count_ > 0) inputs_ = std::make_unique<NodePtr[]>(size_t{input_count_} + value_count_);
  std::copy(values.begin(), values.end(), std::move(inputs.begin(), inputs.end(), inputs_.get()));
  int depth = 1;
  for (const NodePtr& other : dependencies()) depth = std::max(depth, other->depth() + 1);
  depth_ = static_cast<uint16_t>(depth) & 0xFFF;
  uses_cell_ = !traits().gives_cell &&
               (parameters_use_cell() ||
                std::ranges::any_of(dependencies(), [](const NodePtr& other) { return other->uses_cell(); }));
  const Metric metric = find_metric(Inputs(*this, nullptr));
  lipschitz_ = metric.lipschitz;
  kind_ = static_cast<uint16_t>(metric.kind) & 7;
}

std::optional<Affine> here_from_input(const Node& node) {
  program::Builder builder;
  const auto inner = node.inner(Point::origin_frame(builder));
  const auto input_from_here = inner ? inner->from_inputs() : std::nullopt;
  return input_from_here ? std::optional(inverse(*input_from_here)) : std::nullopt;
}

Traits Node::traits_of_shape() const {
  const Node* node = this;
  while (node->keeps_shape()) node = node->inputs().front().get();
  return node->traits();
}

size_t Node::first_output() const {
  size_t output = 0;
  while (!gives(output)) ++output;
  return output;
}

Box BoundsMemory::of(const Node& node, const Box& where, double margin) {
  // Short chains of nodes are evaluated again, since caching would cost more.
  constexpr int few = 4;
  if (node.depth() <= few && node.inputs().size() <= 1) return node.reach(Inputs(node, nullptr, this), where, margin);
  const auto known = last_.find(&node);
  if (known != last_.end() && known->second.where == where && known->second.margin == margin) return known->second.box;
  const Box box = node.reach(Inputs(node, nullptr, this), where, margin);
  last_[&node] = {where, margin, box};
  return box;
}

Box Node::bounds(const Box& where, double margin) const {
  BoundsMemory memory;
  return memory.of(*this, where, margin);
}

Node::~Node() {
  std::vector<NodePtr> open;
  const auto take_inputs = [&open](Node& node) {
    for (uint32_t i = 0; i < node.input_count_ + node.value_count_; ++i) open.push_back(std::move(node.inputs_[i]));
  };
  try {
    take_inputs(*this);
    while (!open.empty()) {
      const NodePtr node = std::move(open.back());
      open.pop_back();
      if (node.use_count() == 1) take_inputs(const_cast<Node&>(*node));
    }
  } catch (const std::bad_alloc&) {  // NOLINT: without memory for the list, the inputs that are left end by recursion
  }
}

std::vector<const Node*> topological(const std::vector<NodePtr>& roots) {
  std::vector<const Node*> order;
  std::unordered_set<const Node*> seen;
  // A node with a single owner cannot be visited twice.
  const auto is_new = [&](const NodePtr& node) { return node.use_count() == 1 || seen.insert(node.get()).second; };
  struct Visit {
    const Node* node;
    size_t next;
  };
  std::vector<Visit> stack;
  for (const NodePtr& root : roots) {
    if (is_new(root)) stack.push_back({root.get(), 0});
    while (!stack.empty()) {
      Visit& visit = stack.back();
      if (visit.next == visit.node->dependencies().size()) {
        order.push_back(visit.node);
        stack.pop_back();
        continue;
      }
      const NodePtr& next = visit.node->dependencies()[visit.next++];
      if (is_new(next)) stack.push_back({next.get(), 0});
    }
  }
  return order;
}

}  // namespace ombre::design
