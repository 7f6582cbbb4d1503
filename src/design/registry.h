// The registry of node types. Everything that lists nodes reads it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "design/node.h"

namespace ombre::design {

struct ParameterInfo {
  std::string name, doc;
  PortText text;
  Domain domain;
  Data default_value;              // null if the parameter is required
  bool takes_other_names = false;  // gets the arguments whose names match no other parameter
};

// The effect of empty inputs on a node.
enum class OfNothing : uint8_t {
  gives_nothing,  // one empty input makes the result empty
  left_out,       // empty inputs are ignored; if none is left, the result is empty
  cuts_nothing,   // like left_out, but an empty first input makes the result empty
  counts,         // empty inputs are treated like any others
};

struct OutputInfo {
  std::string name, doc;
  OutputType type;
  Interval range = Interval::everything();  // range of a number
};

// The number of solids that a node takes.
struct InputInfo {
  size_t least = 0, most = 0;
  // One statement of a script, such as a loop or a module call, makes one input, the union of its solids.
  bool grouped = false;
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

  std::string name, category, sentence, example;  // `example` is a .vcad script
  InputInfo inputs;
  std::vector<ParameterInfo> parameters;
  std::vector<OutputInfo> outputs;
  bool gives_solid = true;
  bool is_nothing = false;            // true if its nodes are solids without points
  const NodeType* nothing = nullptr;  // the registry's type of empty solids, or null

  // Nodes that are not solids give values. Solids may have outputs, too.
  bool is_solid() const { return gives_solid; }
  // Returns the position of the output with this name.
  std::optional<size_t> output(std::string_view output_name) const;

  virtual std::shared_ptr<Node> create() const = 0;
  virtual bool set(Node& node, size_t parameter, const Data& data, const Reader& reader) const = 0;
  virtual Data get(const Node& node, size_t parameter, bool for_hash) const = 0;
  // True if its parameters make it empty, like a text without letters.
  virtual bool makes_nothing(const Node& node) const = 0;
  // Fills in values that defaults leave open and checks combinations of parameters.
  virtual bool complete(Node& node, const Reader& reader, const std::vector<NodePtr>& inputs) const = 0;

  // Returns a copy of the node with other inputs. Data that it computed from its inputs when it was made is not
  // updated.
  virtual NodePtr with_inputs(const Node& node, std::vector<NodePtr> others) const = 0;

  // Returns the number of the parameter, or -1.
  int parameter(std::string_view parameter_name) const;
  std::vector<std::string> parameter_names() const;
};

class Registry {
 public:
  // Adds node types of a category, made from their plain structs (design/spec.h), in the order of the palette.
  template <class... Nodes>
  void add(std::string_view category);

  const std::vector<std::unique_ptr<NodeType>>& types() const { return types_; }
  // Finds a type by name; case, '-' and '_' are ignored.
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

// Greatest depth of nested nodes. Code that walks a design may be recursive.
inline constexpr int deepest_design = 400;
// Greatest number of value nodes whose outputs the parameters of one node may hold.
inline constexpr size_t most_values = 65535;

// Makes a node. Returns null and adds diagnostics if something is wrong. If the solid turns out to be empty, returns a
// node of the registry's empty type.
NodePtr make_node(const NodeType& type, const std::vector<NamedValue>& values, std::vector<NodePtr> inputs,
                  const Reader& reader);
// Makes an empty solid in place of a node of the type. Returns null if the registry has no type of empty solids.
NodePtr make_nothing(const NodeType& type, const SourceRange& where);

}  // namespace ombre::design
