// The node types there are. Everything that lists nodes reads this.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "design/node.h"

namespace ombre::design {

struct ParameterInfo {
  std::string name, doc;
  std::string_view kind;  // "number or field", ...
  Domain domain;
  Data default_value;  // null when it is required
};

// What a node makes of inputs that are nothing.
enum class OfNothing : uint8_t {
  gives_nothing,  // where one of them is nothing, so is the whole
  left_out,       // they do not count; where none is left, the whole is nothing
  cuts_nothing,   // the same, but of a first input that is nothing, nothing is left
  counts,         // they are inputs like any others
};

struct OutputInfo {
  std::string name, doc;
  ValueType type = ValueType::number;
  Interval range = Interval::everything();  // of a number
};

// How many solids a node takes.
struct InputInfo {
  size_t least = 0, most = 0;
  bool grouped = false;  // what one statement of a script makes (a loop, a module) is one input, its union
  OfNothing of_nothing = OfNothing::gives_nothing;
};
inline constexpr InputInfo no_inputs{};
inline constexpr InputInfo one_solid{1, 1};
inline constexpr InputInfo many_solids{1, std::numeric_limits<size_t>::max(), false, OfNothing::left_out};
inline constexpr InputInfo grouped_solids(OfNothing of_nothing) {
  return {1, std::numeric_limits<size_t>::max(), true, of_nothing};
}

class NodeType {
 public:
  virtual ~NodeType() = default;

  std::string name, category, sentence, example;  // `example` is .vcad
  InputInfo inputs;
  std::vector<ParameterInfo> parameters;
  std::vector<OutputInfo> outputs;    // of value nodes; at most one is a mixture
  bool is_nothing = false;            // its nodes are solids without a point
  const NodeType* nothing = nullptr;  // the type of its registry that is nothing; null: there is none

  // Nodes that are no solids give values.
  bool is_solid() const { return outputs.empty(); }
  // The place of the output that is a mixture, or one beyond the last.
  size_t mixture_output() const;

  virtual std::shared_ptr<Node> create() const = 0;
  virtual bool set(Node& node, size_t parameter, const Data& data, const Reader& reader) const = 0;
  virtual Data get(const Node& node, size_t parameter, bool for_hash) const = 0;
  // Do its parameters say that it is nothing, as a text without letters does?
  virtual bool makes_nothing(const Node& node) const = 0;
  // Fills in what defaults leave open and checks what involves several parameters.
  virtual bool complete(Node& node, const Reader& reader, const std::vector<NodePtr>& inputs) const = 0;

  // A copy of the node over other inputs. What it computed from its inputs when it was made stays as it is.
  virtual NodePtr with_inputs(const Node& node, std::vector<NodePtr> others) const = 0;

  // Index of the parameter, or -1.
  int parameter(std::string_view parameter_name) const;
  std::vector<std::string> parameter_names() const;
};

class Registry {
 public:
  // Adds node types from their plain structs (design/spec.h), in palette order.
  template <class... Nodes>
  void add();

  const std::vector<std::unique_ptr<NodeType>>& types() const { return types_; }
  // Matches without regard to case, '-' and '_'.
  const NodeType* find(std::string_view name) const;
  std::vector<std::string> names() const;
  std::vector<std::string> solid_names() const;
  std::vector<std::string> value_names() const;

 private:
  void add_type(std::unique_ptr<NodeType> type);

  std::vector<std::unique_ptr<NodeType>> types_;
  std::map<std::string, const NodeType*, std::less<>> by_name_;
  const NodeType* nothing_ = nullptr;
};

struct NamedValue {
  const ParameterInfo* parameter;
  Data data;
};

// Nodes above one another; what walks a design may recurse.
inline constexpr int deepest_design = 400;
// Value nodes whose outputs one node's parameters may hold.
inline constexpr size_t most_values = 65535;

// Makes a node. Null, and diagnostics, when something is wrong with it. What turns out to be nothing is a node of the
// type that says so, whatever it was made from.
NodePtr make_node(const NodeType& type, const std::vector<NamedValue>& values, std::vector<NodePtr> inputs,
                  const Reader& reader);
// A solid without a point, for a node of the type; null where its registry has none.
NodePtr make_nothing(const NodeType& type, const SourceRange& where);

}  // namespace ombre::design
