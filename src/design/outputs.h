// Outputs of value nodes, and the data that gives them to parameters.
#pragma once

#include <map>
#include <tuple>

#include "base/text/data.h"
#include "design/lowered.h"
#include "expr/expression.h"

namespace ombre::design {

class Node;
using NodePtr = std::shared_ptr<const Node>;
struct Reader;
struct Domain;

// A vector that varies in space.
struct VectorField {
  Field x, y, z;
  Field operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

// A number that a node gives, or one coordinate of a vector.
struct NodeOutput {
  NodePtr node;
  size_t output = 0;  // position in the type's list of outputs
  int axis = -1;      // coordinate of a vector

  std::string name() const;  // the output's name: "value" or "index.x"
};

// Computes fields of outputs at points of its builder.
class OutputFields : public program::BuilderUser {
 public:
  virtual Field number(const NodeOutput& output, const Point& p) = 0;
};

// Computes fields of outputs without a lowering. It must live as long as the builder uses it.
class OutputsAlone : public OutputFields {
 public:
  // With `by_ranges`, a number with a declared range may have any value within it.
  OutputsAlone(program::Builder& builder, bool by_ranges) : builder_(builder), by_ranges_(by_ranges) {
    builder.set_user(this);
  }
  ~OutputsAlone() override { builder_.set_user(nullptr); }
  OutputsAlone(const OutputsAlone&) = delete;
  OutputsAlone& operator=(const OutputsAlone&) = delete;

  Field number(const NodeOutput& output, const Point& p) override;

 private:
  using Key = std::tuple<const Node*, size_t, program::ValueId, program::ValueId, program::ValueId>;

  program::Builder& builder_;
  bool by_ranges_;
  std::map<Key, VectorField> known_;
};

// Returns a field that may have any value in a range, for evaluation of ranges only.
Field anything(const Point& p, const Interval& range = Interval::everything());

// An output as an operand of formulas.
class OutputInput final : public expr::Input {
 public:
  explicit OutputInput(NodeOutput output) : output_(std::move(output)) {}
  const NodeOutput& output() const { return output_; }
  Field field(const Point& p) const override;
  std::string name() const override;
  bool is_same(const Input& other) const override;

 private:
  NodeOutput output_;
};

expr::Expression expression_of(NodeOutput output);
// Returns the nodes whose outputs a formula uses, in order of occurrence.
std::vector<NodePtr> nodes_of(const expr::Expression& expression);

// Data that stands for the first output that the node gives.
class NodeObject final : public HostObject {
 public:
  explicit NodeObject(NodePtr node) : node_(std::move(node)) {}
  const NodePtr& node() const { return node_; }
  std::string describe() const override;

 private:
  NodePtr node_;
};

// Data that stands for a formula of outputs.
class FormulaObject final : public HostObject {
 public:
  explicit FormulaObject(expr::Expression expression) : expression_(std::move(expression)) {}
  const expr::Expression& expression() const { return expression_; }
  std::string describe() const override { return "a value that varies in space"; }

 private:
  expr::Expression expression_;
};

// True if the data is one of these two, or an object such as {"from": ..., "output": "value"}.
bool is_value(const Data& data);
bool is_mixture(const Data& data);  // true for a mixture of materials
// Reads data that is a value. Returns nothing and adds a diagnostic if it gives no number.
std::optional<expr::Expression> read_formula(const Data& data, const Domain& domain, const Reader& reader);
// Returns the numbers of an output that has several, such as a node's index. Returns an empty list for other data.
std::vector<expr::Expression> vector_of(const Data& data, const Reader& reader);
// Reads an output that is a mixture. Returns null and adds a diagnostic if it is none.
NodePtr read_mixture(const Data& data, const Reader& reader);

// Returns {"from": node, "output": "value"} or {"formula": "2*v", "with": {"v": {"from": node, "output": "value"}}}, in
// which nodes are NodeObjects.
Data write_formula(const expr::Expression& expression);
Data write_mixture(const Node& node);  // its NodeObject does not own the node
// Reads a solid as a parameter: a NodeObject or {"from": node}. Returns null and adds a diagnostic if it is no solid.
NodePtr read_solid(const Data& data, const Reader& reader);
Data write_solid(const Node& node);  // its NodeObject does not own the node
// Returns the data with all its NodeObjects replaced by ones that own their nodes, which are among `nodes`.
Data with_held_nodes(const Data& data, std::span<const NodePtr> nodes);
// Replaces each NodeObject by the text that `name` returns.
Data with_names(const Data& data, const std::function<std::string(const Node&)>& name);

}  // namespace ombre::design
