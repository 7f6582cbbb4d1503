// Outputs of value nodes, and the data that gives them to parameters.
#pragma once

#include <array>
#include <map>
#include <tuple>

#include "base/system/not_copied.h"
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

// The numbers of an output at a point: one, three of a vector or frame, four of a colour; the others are not set.
using Numbers4 = std::array<Field, 4>;

// Returns `yes` where the flag is 1, else `no`.
Numbers4 select(Field flag, const Numbers4& yes, const Numbers4& no);

// The name of the output of struts that runs from 0 at their start to 1 at their end; formulas over struts call it t.
inline constexpr std::string_view along_output = "along";

// How an output is given.
enum class OutputForm : uint8_t {
  numbers,   // one to four numbers that vary in space
  mixture,   // a composition that varies in space
  solid,     // a solid or region, which `solid_of` makes a node
  constant,  // plain data of a type of parameters, known when the node is made
};

std::string_view name(OutputForm form);

// The type of an output (design/ports/output.h).
struct OutputType {
  std::string name;        // in help and in the reference: "number", "vector", "list of points"
  std::string_view parts;  // a letter for each of several numbers: "xyz", "rgba"
  OutputForm form = OutputForm::numbers;
  std::string python;  // its type in Python's stubs

  bool is_number() const { return form == OutputForm::numbers && parts.empty(); }
  bool has_parts() const { return !parts.empty(); }
};

// A number that a node gives, or one of several.
struct NodeOutput {
  NodePtr node;
  size_t output = 0;  // position in the type's list of outputs
  int part = -1;      // position in the type's parts, or -1 if it has none

  std::string name() const;  // the output's name: "value" or "index.x"
};

// An output of a node, which the node with the parameter owns.
struct GivenOutput {
  const Node* node = nullptr;
  size_t output = 0;
  bool operator==(const GivenOutput&) const = default;
};

// Computes fields of outputs at points of its builder.
class OutputFields : public program::BuilderUser {
 public:
  virtual Field number(const NodeOutput& output, const Point& p) = 0;
};

// Computes fields of outputs without a lowering. It must live as long as the builder uses it.
class OutputsAlone : public OutputFields, NotCopied {
 public:
  // With `by_ranges`, a number with a declared range may have any value within it.
  OutputsAlone(program::Builder& builder, bool by_ranges) : builder_(builder), by_ranges_(by_ranges) {
    builder.set_user(this);
  }
  ~OutputsAlone() override { builder_.set_user(nullptr); }

  Field number(const NodeOutput& output, const Point& p) override;

 private:
  using Key = std::tuple<const Node*, size_t, program::ValueId, program::ValueId, program::ValueId>;

  program::Builder& builder_;
  bool by_ranges_;
  std::map<Key, Numbers4> known_;
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

// Data that stands for a solid, or for the first output that a node of values gives.
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
// Reads an output that is a mixture, and keeps its node. Returns nothing and adds a diagnostic if it is none.
std::optional<GivenOutput> read_mixture(const Data& data, const Reader& reader);
// Replaces outputs that are constants by their values. Returns nothing if there are none.
std::optional<Data> with_constants(const Data& data);

// Returns {"from": node, "output": "value"} or {"formula": "2*v", "with": {"v": {"from": node, "output": "value"}}}, in
// which nodes are NodeObjects.
Data write_formula(const expr::Expression& expression);
// The NodeObject in the data holds `owner`, or does not own the node if that is null.
Data write_output(const GivenOutput& output, const NodePtr& owner = nullptr);
// Reads a solid as a parameter: a NodeObject, {"from": node}, or an output that is a solid or region. Returns nothing
// and adds a diagnostic if it is not a solid.
std::optional<GivenOutput> read_solid(const Data& data, const Reader& reader);
Data write_solid(const GivenOutput& solid);  // its NodeObject does not own the node
// Returns the data with all its NodeObjects replaced by ones that own their nodes, which are among `nodes`.
Data with_held_nodes(const Data& data, std::span<const NodePtr> nodes);
// Replaces each NodeObject by the text that `name` returns.
Data with_names(const Data& data, const std::function<std::string(const Node&)>& name);

}  // namespace ombre::design
