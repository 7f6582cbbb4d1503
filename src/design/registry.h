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

// How many inputs a node takes, and of which type.
struct InputInfo {
  ValueType type = ValueType::solid;
  size_t least = 0, most = 0;
  bool grouped = false;  // what one statement of a script makes (a loop, a module) is one input, its union
};
inline constexpr InputInfo no_inputs{};
inline constexpr InputInfo one_solid{ValueType::solid, 1, 1};
inline constexpr InputInfo many_solids{ValueType::solid, 1, std::numeric_limits<size_t>::max()};
inline constexpr InputInfo grouped_solids{ValueType::solid, 1, std::numeric_limits<size_t>::max(), true};

class NodeType {
 public:
  virtual ~NodeType() = default;

  std::string name, category, sentence, example;  // `example` is .vcad
  InputInfo inputs;
  ValueType output = ValueType::solid;
  std::vector<ParameterInfo> parameters;

  virtual std::shared_ptr<Node> create() const = 0;
  virtual bool set(Node& node, size_t parameter, const Data& data, const Reader& reader) const = 0;
  virtual Data get(const Node& node, size_t parameter, bool for_hash) const = 0;
  // Fills in what defaults leave open and checks what involves several parameters.
  virtual bool complete(Node& node, const Reader& reader, const std::vector<NodePtr>& inputs) const = 0;

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

 private:
  void add_type(std::unique_ptr<NodeType> type);

  std::vector<std::unique_ptr<NodeType>> types_;
  std::map<std::string, const NodeType*, std::less<>> by_name_;
};

struct NamedValue {
  const ParameterInfo* parameter;
  Data data;
};

// Nodes above one another; what walks a design may recurse.
inline constexpr int deepest_design = 400;

// Makes a node. Null, and diagnostics, when something is wrong with it.
NodePtr make_node(const NodeType& type, const std::vector<NamedValue>& values, std::vector<NodePtr> inputs,
                  const Reader& reader);

}  // namespace ombre::design
