// Nodes: a type, its parameters, its inputs. Immutable once made; shared where used twice.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "design/job_scale.h"
#include "design/lowered.h"
#include "design/outputs.h"
#include "design/values.h"

namespace ombre::design {

class Lowering;
class NodeType;
class Stage;

// Bounds already asked for: a sub-design may be reached in very many ways.
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
  // Encloses the points of `where` at which the part's g is `margin` or less.
  virtual Box reach(size_t i, const Box& where, double margin) const = 0;
  virtual bool uses_cell(size_t i) const = 0;
  virtual Field distance(const Inputs& in, size_t i, const Point& p) const = 0;
  virtual Field membership(const Inputs& in, size_t i, const Point& p, Border border) const = 0;
  virtual Field along(const Inputs& in, size_t i, const Point& p) const = 0;
  virtual Composition composition(const Inputs& in, size_t i, const Point& p, Demand demand) const = 0;
};

// A node's inputs as its methods see them: by number, at a point of the node's choice.
class Inputs {
 public:
  Inputs(const Node& node, Lowering* lowering, BoundsMemory* memory = nullptr)
      : node_(node), lowering_(lowering), memory_(memory) {}

  size_t count() const;
  // Are only bounds, the metric or ranges of numbers asked for? Then nothing is known of solids but that.
  bool are_ranges() const { return !lowering_; }
  const Node& node() const { return node_; }
  const Node& input(size_t i) const;

  Box bounds(size_t i, const Box& where) const { return reach(i, where, 0); }
  // Encloses the points of `where` at which the input's g is `margin` or less; margin >= 0.
  Box reach(size_t i, const Box& where, double margin) const;
  Metric metric(size_t i) const;

  Field distance(size_t i, const Point& p) const;
  Field membership(size_t i, const Point& p, Border border) const;  // truth value
  Field inside(size_t i, const Point& p) const { return membership(i, p, Border::included); }
  Composition composition(size_t i, const Point& p, Demand demand) const;
  Field attribute(size_t i, std::string_view attribute_name, const Point& p, Demand demand) const;
  bool has_attribute(size_t i, std::string_view attribute_name) const;
  Field along(size_t i, const Point& p) const;
  AttributeDeclaration declaration(std::string_view attribute_name) const;

  // The inputs as a table of many parts; nothing if they are few.
  std::optional<PartFields> many_parts(PartQuery query, const Point& p, const Falloff* falloff = nullptr) const;
  // The same of parts that the node has itself.
  std::optional<PartFields> many_parts(PartQuery query, const Point& p, const PartList& list) const;

  // All inputs at one point.
  std::vector<Field> distances(const Point& p) const;
  std::vector<Field> memberships(const Point& p, Border border) const;

  MaterialId material(const MaterialName& name) const;  // which is no mixture
  // The composition of a material alone, or of the mixture at the point.
  Composition composition_of(const MaterialName& name, const Point& p) const;
  // Of a solid that a parameter holds: mm, negative inside. Anything where only ranges are evaluated.
  Field distance_to(const SolidName& solid, const Point& p) const;
  Field inside_of(const SolidName& solid, const Point& p) const;
  // What it is made of at the point, inside or not. Not where only ranges are evaluated.
  Composition composition_of(const SolidName& solid, const Point& p) const;
  // One of the numbers of its attributes.
  Field attribute_of(const SolidName& solid, std::string_view attribute_name, const Point& p) const;
  // The input's attribute, or number of one, that formulas call by this name in small letters; empty: it has none.
  std::string attribute_called(size_t i, std::string_view lower_case) const;
  // How fine the job is in this node's space, if it is known.
  std::optional<JobScale> scale() const;
  // The source that gives what a stage of this node computes.
  program::SourceField staged(const std::shared_ptr<const Stage>& stage) const;
  // Reported once for each job that lowers the node.
  void report(Severity severity, const std::string& message, const Phrase& hint) const;
  // A flag that is 1 where something is wrong; `message` is reported once, with the count of voxels.
  std::pair<uint32_t, Field> check(Field bad, const std::string& message) const;

 private:
  const Node& node_;
  Lowering* lowering_;    // null where only bounds or the metric are asked for
  BoundsMemory* memory_;  // set where bounds are asked for
};

// What a node's outputs are evaluated with. Where only ranges of numbers are evaluated, `in` has no lowering: it knows
// the inputs' bounds, and nothing else.
struct Ask {
  const Inputs& in;
  const Point& p;
};

// What helps to make a faster program of a design. No trait changes what a design means.
struct Traits {
  double most_evaluations_of_input = 1;  // an upper bound of how often one evaluation of the node evaluates an input
  size_t instances = 1;                  // number of inner solids (struts, say) that may become rows of a table
  bool gives_cell = false;               // does it set the cell's numbers ci, cj and ck for what lies below it?
  std::optional<Vec3> cell_size = {};    // steps at which copies of a unit cell join, mm
  // Of copies at steps of at least these (mm), the one whose origin is nearest always has the least g, wherever the
  // others are.
  Vec3 nearest_copy_is_enough_from = {Box::inf, Box::inf, Box::inf};
};

// Its parameters, and what they mean, are in the type that is made from a plain struct (spec.h). One piece of
// memory holds all of it but lists: designs may have millions.
class Node {
 public:
  Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  virtual ~Node();  // without recursion: chains may be long
  // What a node gets when its parameters are set; from then on it stays as it is.
  void finish(std::vector<NodePtr> inputs, const std::vector<NodePtr>& values, SourceRange where);

  virtual const NodeType& type() const = 0;
  // Encloses the points of `where` at which g is `margin` (mm, not negative) or less.
  virtual Box reach(const Inputs& in, const Box& where, double margin) const = 0;
  // Solids give `distance`; the others have defaults that follow from it or from the inputs.
  virtual Field distance(const Inputs& in, const Point& p) const = 0;
  virtual std::optional<Field> membership(const Inputs& in, const Point& p, Border border) const = 0;
  virtual std::optional<Composition> composition(const Inputs& in, const Point& p, Demand demand) const = 0;
  virtual std::optional<Field> attribute(const Inputs& in, std::string_view name, const Point& p,
                                         Demand demand) const = 0;
  virtual std::optional<AttributeDeclaration> declares() const = 0;  // the attribute that it sets
  // Is it of its one input's shape, to which it gives a material, an attribute or a name?
  virtual bool keeps_shape() const = 0;
  // Where a node that only moves the question asks its input.
  virtual std::optional<Point> inner(const Point& p) const = 0;
  // Along struts: 0 at their start, 1 at their end. Nothing where the inputs are to be evaluated.
  virtual std::optional<Field> along(const Inputs& in, const Point& p) const = 0;
  virtual Traits traits() const = 0;
  // Of the shape that it has: its own, or those of the node that it carries something to.
  Traits traits_of_shape() const;

  // Value nodes have outputs, in the order of their type's list.
  virtual bool gives(size_t output) const = 0;                           // do its parameters allow this one?
  virtual VectorField numbers(size_t output, const Ask& ask) const = 0;  // of a number x alone
  virtual Composition mixture(const Ask& ask) const = 0;
  size_t first_output() const;  // that it gives

  std::span<const NodePtr> inputs() const { return {inputs_.get(), input_count_}; }
  // The nodes whose outputs its parameters hold, each once.
  std::span<const NodePtr> values() const { return {inputs_.get() + input_count_, value_count_}; }
  // Both.
  std::span<const NodePtr> dependencies() const { return {inputs_.get(), size_t{input_count_} + value_count_}; }
  const SourceRange& where() const { return where_; }

  bool is_nothing() const;  // a solid without a point

  // The smallest known box around what is inside within `where`.
  Box bounds(const Box& where) const;
  Metric metric() const { return {static_cast<Metric::Kind>(kind_), lipschitz_}; }
  int depth() const { return depth_; }  // 1 for a leaf
  // Do its numbers, or those of its inputs, depend on the cell that a repeating node above it gives?
  bool uses_cell() const { return uses_cell_; }
  bool has_along() const;  // is it, or one of its inputs, made of struts?

 private:
  virtual Metric find_metric(const Inputs& in) const = 0;
  virtual bool gives_along() const = 0;
  virtual bool has_cell_numbers() const = 0;

  SourceRange where_;
  std::unique_ptr<NodePtr[]> inputs_;  // and then the values
  uint32_t input_count_ = 0;
  uint16_t value_count_ = 0;
  // In few bits, since designs may have millions of nodes; the metric in parts.
  uint16_t depth_ : 12 = 1;
  uint16_t kind_ : 3 = 0;
  uint16_t uses_cell_ : 1 = 0;
  double lipschitz_ = 1;
};

// All nodes below and including the roots, each once, inputs and values before the nodes that use them.
std::vector<const Node*> topological(const std::vector<NodePtr>& roots);

}  // namespace ombre::design
