// Outputs of value nodes, and the data by which parameters are given them.
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
  size_t output = 0;  // its place in the list of the node's type
  int axis = -1;      // of a vector

  std::string name() const;  // "value", "index.x"
};

// Gives the fields of outputs at points of its builder.
class OutputFields : public program::BuilderUser {
 public:
  virtual Field number(const NodeOutput& output, const Point& p) = 0;
};

// The fields of outputs where there is no lowering, for as long as this lives.
class OutputsAlone : public OutputFields {
 public:
  // `by_ranges`: a number with a declared range may be anything within it.
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

// A field that may be anything in a range, where only ranges are evaluated.
Field anything(const Point& p, const Interval& range = Interval::everything());

// An output as a part of formulas.
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
// The nodes whose outputs a formula holds, in its order.
std::vector<NodePtr> nodes_of(const expr::Expression& expression);

// Data that stands for the first output of a node that the node gives.
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

// Is the data one of these two, or an object such as {"from": ..., "output": "value"}?
bool is_value(const Data& data);
bool is_mixture(const Data& data);  // of materials
// Reads data that is a value. Nothing, and a diagnostic, when it gives no number.
std::optional<expr::Expression> read_formula(const Data& data, const Domain& domain, const Reader& reader);
// The numbers of data that is an output with several, such as a node's index; empty for other data.
std::vector<expr::Expression> vector_of(const Data& data, const Reader& reader);
// The same for mixtures; null, and a diagnostic, when it gives none.
NodePtr read_mixture(const Data& data, const Reader& reader);

// {"from": node, "output": "value"} or {"formula": "2*v", "with": {"v": {"from": node, "output": "value"}}}, where the
// nodes are NodeObjects.
Data write_formula(const expr::Expression& expression);
Data write_mixture(const Node& node);  // its NodeObject does not hold the node
// A solid as a parameter: a NodeObject, or {"from": node}. Null, and a diagnostic, when it is no solid.
NodePtr read_solid(const Data& data, const Reader& reader);
Data write_solid(const Node& node);  // as of mixtures
// Data of a parameter, of which all NodeObjects hold their nodes, which are among `nodes`.
Data with_held_nodes(const Data& data, std::span<const NodePtr> nodes);
// Replaces each NodeObject by the text that `name` gives.
Data with_names(const Data& data, const std::function<std::string(const Node&)>& name);

}  // namespace ombre::design
