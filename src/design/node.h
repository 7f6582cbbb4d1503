// Nodes: a type, parameters and inputs. A node is immutable once made, and shared if it is used more than once.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/system/not_copied.h"
#include "design/job_scale.h"
#include "design/lowered.h"
#include "design/outputs.h"
#include "design/ports/output.h"
#include "design/values.h"

namespace ombre::design {

class Lowering;
class NodeType;
class Stage;

// A cache of bounds, since a sub-design may be reached in very many ways.
class BoundsMemory {
 public:
  Box of(const Node& node, const Box& where, double margin);

 private:
  struct Answer {
    Box where;
    double margin;
    Box box;
  };
  std::map<const Node*, Answer> last_;
};

class Inputs;

// Solids within a node that may become rows of a table.
class PartList {
 public:
  virtual ~PartList() = default;
  virtual size_t count() const = 0;
  // Returns a box around the points of `where` at which the part's distance function g is at most `margin`.
  virtual Box reach(size_t i, const Box& where, double margin) const = 0;
  virtual bool uses_cell(size_t i) const = 0;
  virtual Field distance(const Inputs& in, size_t i, const Point& p) const = 0;
  virtual Field membership(const Inputs& in, size_t i, const Point& p, Border border) const = 0;
  virtual Field along(const Inputs& in, size_t i, const Point& p) const = 0;
  virtual Composition composition(const Inputs& in, size_t i, const Point& p, Demand demand) const = 0;
};

// The inputs of a node as its methods see them: selected by number, and evaluated at a point that the method chooses.
class Inputs {
 public:
  Inputs(const Node& node, Lowering* lowering, BoundsMemory* memory = nullptr)
      : node_(node), lowering_(lowering), memory_(memory) {}

  size_t count() const;
  // True if only bounds, the metric or ranges of numbers are computed. Nothing else is known of the inputs then.
  bool are_ranges() const { return !lowering_; }
  const Node& node() const { return node_; }
  const Node& input(size_t i) const;

  Box bounds(size_t i, const Box& where) const { return reach(i, where, 0); }
  // Returns a box around the points of `where` at which the input's g is at most `margin`, which must be >= 0.
  Box reach(size_t i, const Box& where, double margin) const;
  Metric metric(size_t i) const;

  Field distance(size_t i, const Point& p) const;
  Field membership(size_t i, const Point& p, Border border) const;  // a truth value
  Field inside(size_t i, const Point& p) const { return membership(i, p, Border::included); }
  Composition composition(size_t i, const Point& p, Demand demand) const;
  Field attribute(size_t i, std::string_view attribute_name, const Point& p, Demand demand) const;
  bool has_attribute(size_t i, std::string_view attribute_name) const;
  // Returns the numbers of the output with this name that the input has, of its own or from its inputs, or else 0.
  Numbers4 output(size_t i, std::string_view output_name, const Point& p) const;
  AttributeDeclaration declaration(std::string_view attribute_name) const;

  // Returns the inputs as a table of many parts, or nothing if there are too few.
  std::optional<PartFields> many_parts(PartQuery query, const Point& p, const Falloff* falloff = nullptr) const;
  // Returns a table of parts that are not inputs, or nothing if there are too few.
  std::optional<PartFields> many_parts(PartQuery query, const Point& p, const PartList& list) const;

  // Evaluates all inputs at one point.
  std::vector<Field> distances(const Point& p) const;
  std::vector<Field> memberships(const Point& p, Border border) const;

  MaterialId material(const MaterialName& name) const;  // must not be a mixture
  // Returns the composition of a single material, or of the mixture at the point.
  Composition composition_of(const MaterialName& name, const Point& p) const;
  // Returns the distance in mm to a solid that a parameter holds, negative inside. If only ranges are evaluated,
  // returns a field that may have any value.
  Field distance_to(const SolidName& solid, const Point& p) const;
  Field inside_of(const SolidName& solid, const Point& p) const;
  // Returns the composition of the solid at the point, inside or outside. Must not be called if only ranges are
  // evaluated.
  Composition composition_of(const SolidName& solid, const Point& p) const;
  // Returns the numbers of an output that a solid, or a node below it, has.
  Numbers4 output_of(const SolidName& solid, std::string_view output_name, const Point& p) const;
  // Returns a number of one of the solid's attributes.
  Field attribute_of(const SolidName& solid, std::string_view attribute_name, const Point& p) const;
  // Returns the name of the input's attribute, or of its number, whose lower-case name this is; "" if there is none.
  std::string attribute_called(size_t i, std::string_view lower_case) const;
  // Returns the scale of the job in this node's space, if known.
  std::optional<JobScale> scale() const;
  // Returns the source of the values that a stage of this node computes.
  program::SourceField staged(const std::shared_ptr<const Stage>& stage) const;
  // Reports a message once for each job that lowers the node.
  void report(Severity severity, const std::string& message, const Phrase& hint) const;
  // Registers a check. `bad` is 1 where something is wrong; then `message` is reported once, with the number of voxels.
  std::pair<uint32_t, Field> check(Field bad, const std::string& message) const;

 private:
  const Node& node_;
  Lowering* lowering_;    // null if only bounds or the metric are computed
  BoundsMemory* memory_;  // set while bounds are computed
};

// The arguments of a node's outputs. If only ranges are evaluated, `in` has no lowering and knows only the inputs'
// bounds.
struct Ask {
  const Inputs& in;
  const Point& p;
};

// Hints for faster programs. They do not change the meaning of a design.
struct Traits {
  double most_evaluations_of_input = 1;  // greatest number of evaluations of an input during one evaluation of the node
  size_t instances = 1;                  // number of inner solids, such as struts, that may become rows of a table
  bool gives_cell = false;               // true if it sets the cell's numbers ci, cj and ck for the nodes below
  std::optional<Vec3> cell_size = {};    // steps in mm at which copies of a unit cell join
  // Least steps in mm between copies for which the copy with the nearest origin always has the least g.
  Vec3 nearest_copy_is_enough_from = {Box::inf, Box::inf, Box::inf};
};

// A node of a design. Its type, which is made from a plain struct (spec.h), describes its parameters. Except for lists
// a node occupies a single block of memory, since designs may have millions.
class Node : NotCopied {
 public:
  Node() = default;
  virtual ~Node();  // not recursive, since chains may be long
  // Completes a node after its parameters are set. It is immutable from then on.
  void finish(std::vector<NodePtr> inputs, const std::vector<NodePtr>& values, SourceRange where);

  virtual const NodeType& type() const = 0;
  // Returns a box around the points of `where` at which g is at most `margin` (mm, not negative).
  virtual Box reach(const Inputs& in, const Box& where, double margin) const = 0;
  // Solids implement `distance`. The other functions have defaults that use it or the inputs.
  virtual Field distance(const Inputs& in, const Point& p) const = 0;
  virtual std::optional<Field> membership(const Inputs& in, const Point& p, Border border) const = 0;
  virtual std::optional<Composition> composition(const Inputs& in, const Point& p, Demand demand) const = 0;
  virtual std::optional<Field> attribute(const Inputs& in, std::string_view name, const Point& p,
                                         Demand demand) const = 0;
  virtual std::optional<AttributeDeclaration> declares() const = 0;  // the attribute that it sets
  // True if it has the shape of its single input, to which it adds a material, an attribute or a name.
  virtual bool keeps_shape() const = 0;
  // Returns the point at which the input is evaluated, if the node only maps points.
  virtual std::optional<Point> inner(const Point& p) const = 0;
  // Returns the numbers of an output of its inputs, which have it, or nothing if the first input that holds the point
  // decides.
  virtual std::optional<Numbers4> passed(const Inputs& in, std::string_view output, const Point& p) const = 0;
  virtual Traits traits() const = 0;
  // Returns the traits of its shape: its own, or those of its input if it keeps that shape.
  Traits traits_of_shape() const;

  // Outputs are numbered in the order of their type's list.
  virtual bool gives(size_t output) const = 0;  // false if its parameters rule this output out
  // Returns the value of an output that varies in space.
  virtual OutputAnswer answer(size_t output, const Ask& ask) const = 0;
  virtual Data constant(size_t output) const = 0;  // of an output that is a constant
  // Returns a box around the inside of an output that is a solid or region, within `where`.
  virtual Box output_bounds(size_t output, const Box& where) const = 0;
  size_t first_output() const;  // the first one that gives() allows
  bool is_mixture() const;      // true for a node of values whose first output is a mixture
  // Returns the type of the output with this name that this node or a node below has, or null.
  const OutputType* output_type(std::string_view output_name) const;
  // Returns the names of the outputs that this node and the nodes below have, each once.
  std::vector<std::string> output_names() const;

  std::span<const NodePtr> inputs() const { return {inputs_.get(), input_count_}; }
  // Returns the nodes whose outputs its parameters hold, each once.
  std::span<const NodePtr> values() const { return {inputs_.get() + input_count_, value_count_}; }
  // Returns the inputs and the values.
  std::span<const NodePtr> dependencies() const { return {inputs_.get(), size_t{input_count_} + value_count_}; }
  const SourceRange& where() const { return where_; }

  bool is_nothing() const;  // true for a solid without points

  // Returns the smallest known box around the points of `where` at which g is at most `margin`: by default the inside.
  Box bounds(const Box& where, double margin = 0) const;
  Metric metric() const { return {static_cast<Metric::Kind>(kind_), lipschitz_}; }
  int depth() const { return depth_; }  // 1 for a leaf
  // True if its numbers, or those of its inputs, depend on the cell of a repeating node above.
  bool uses_cell() const { return uses_cell_; }

 private:
  virtual Metric find_metric(const Inputs& in) const = 0;
  virtual bool parameters_use_cell() const = 0;  // true if a formula in them uses ci, cj or ck

  SourceRange where_;
  std::unique_ptr<NodePtr[]> inputs_;  // inputs, followed by values
  uint32_t input_count_ = 0;
  uint16_t value_count_ = 0;
  // Stored in few bits, since designs may have millions of nodes. The metric is stored as its kind and its constant.
  uint16_t depth_ : 12 = 1;
  uint16_t kind_ : 3 = 0;
  uint16_t uses_cell_ : 1 = 0;
  double lipschitz_ = 1;
};

// Returns the map from the input's space to the node's, if the node only transforms by an affine map.
std::optional<Affine> here_from_input(const Node& node);

// Returns all nodes at and below the roots, each once. Inputs and values come before the nodes that use them.
std::vector<const Node*> topological(const std::vector<NodePtr>& roots);

}  // namespace ombre::design
