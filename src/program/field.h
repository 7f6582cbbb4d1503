// Fields: expressions over space from which programs are built. Equal expressions are shared.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/system/not_copied.h"
#include "program/program.h"

namespace ombre::program {

class Builder;

// A handle to a value in a builder. It is cheap to copy and valid as long as its builder.
struct Field {
  Builder* builder = nullptr;
  ValueId id = 0;

  explicit operator bool() const { return builder != nullptr; }
  bool operator==(const Field&) const = default;
};

using Outputs = std::vector<std::pair<std::string, Field>>;

// A base for objects that register with a builder, so that code that only has a point can find them.
class BuilderUser {
 public:
  virtual ~BuilderUser() = default;
};

// Builds programs. Shares equal subexpressions and folds constants.
class Builder : NotCopied {
 public:
  Builder();

  Field input(int axis) { return {this, static_cast<ValueId>(axis)}; }
  Field constant(double value);
  Field apply(Op op, Field a, Field b = {}, Field c = {});
  Field affine(const AffineRow& row, Field a, Field b, Field c);
  Field source(const SourceField& source, int channel, Field a, Field b, Field c, uint32_t tag = 0);
  // Calls an output of `body`, which may still grow. Outputs are numbered in the order in which they were added.
  Field call(const std::shared_ptr<Program>& body, uint32_t output, Field a, Field b, Field c);

  // Returns the combined value of one slot of many parts.
  Field parts(const std::shared_ptr<const PartSet>& set, size_t slot, Field a, Field b, Field c);

  std::optional<double> constant_value(Field field) const;
  const Instruction& instruction(Field field) const { return code_[field.id]; }
  const AffineRow& affine_row(Field field) const { return maps_[code_[field.id].aux]; }  // the row of an affine map
  bool is_truth(Field field) const;  // true if the value is always 0 or 1
  size_t size() const { return code_.size(); }
  // Removes all instructions but keeps the memory and the user, for another program.
  void clear();
  BuilderUser* user() const { return user_; }  // null if there is none
  void set_user(BuilderUser* user) { user_ = user; }

  // Returns the program of the instructions that the outputs need, in the order of construction.
  Program finish(const Outputs& outputs) const;
  // Overwrites `program` with that program and reuses its memory.
  void finish(const Outputs& outputs, Program& program) const;

 private:
  struct Key {
    Op op;
    ValueId a, b, c;
    uint64_t bits;
    const void* pointer;
    bool operator==(const Key&) const = default;
  };
  static size_t hash(const Key& key);
  Field intern(const Key& key, Instruction instruction);
  void push(const Key& key, const Instruction& instruction);
  void widen_table();

  BuilderUser* user_ = nullptr;
  std::vector<Instruction> code_;
  std::vector<AffineRow> maps_;
  std::vector<Read> reads_;
  std::vector<Call> calls_;
  std::vector<std::shared_ptr<const PartSet>> part_sets_;
  std::vector<Key> keys_;       // one for each instruction
  std::vector<ValueId> table_;  // hash table of instructions by their keys; 0, which is an input, marks empty entries
};

// Arithmetic on fields. A number stands for a constant.
Field operator+(Field a, Field b);
Field operator-(Field a, Field b);
Field operator*(Field a, Field b);
Field operator/(Field a, Field b);
Field operator-(Field a);
Field operator+(Field a, double b);
Field operator-(Field a, double b);
Field operator*(Field a, double b);
Field operator/(Field a, double b);
Field operator-(double a, Field b);
Field operator*(double a, Field b);
Field min(Field a, Field b);
Field max(Field a, Field b);
Field max(Field a, double b);
Field abs(Field a);
Field sqrt(Field a);
Field square(Field a);
Field signed_square(Field a);  // below 0 where a is
Field ceil(Field a);
Field sin(Field a);
Field cos(Field a);
Field length(Field a, Field b);
Field length(Field a, Field b, Field c);
// Raises to a power. Integer powers become products.
Field power(Field base, Field exponent);
// Truth values are 0 or 1.
Field operator<(Field a, double b);
Field operator<=(Field a, double b);
Field less(Field a, Field b);
Field less_equal(Field a, Field b);
Field truth(Field a);
Field logical_not(Field a);
Field logical_and(Field a, Field b);
Field logical_or(Field a, Field b);
Field share(Field part, Field total);
Field select(Field condition, Field a, Field b);
Field is_finite(Field a);
// Combines a list as a balanced tree, so that `narrow` can drop parts of it.
Field fold(std::vector<Field> fields, Field (*combine)(Field, Field));
Field sum(std::vector<Field> fields);

// A point at which nodes are evaluated: an affine image of a base point whose coordinates are fields.
class Point {
 public:
  Field x, y, z;
  // Indices of the cell from which the point was mapped, if space repeats; else null fields.
  std::array<Field, 3> cell;

  // Returns the point whose coordinates are the inputs of a program or body.
  static Point origin_frame(Builder& builder);
  // Returns a point with these coordinates as a new base.
  static Point of(Field x, Field y, Field z) { return {x, y, z, Affine{}}; }
  // Returns the image of this point under `map`.
  Point mapped(const Affine& map) const;
  // Returns a point with other coordinates that keeps the other properties of this one.
  Point moved_to(Field to_x, Field to_y, Field to_z) const;
  // A box in which the point is known to lie; unbounded if nothing is known.
  const Box& within() const { return within_; }
  void set_within(const Box& box) { within_ = box; }
  // Returns the affine map from the builder's inputs to this point, or nothing if there is none.
  std::optional<Affine> from_inputs() const;
  Field constant(double value) const { return x.builder->constant(value); }
  Builder& builder() const { return *x.builder; }

 private:
  Point(Field bx, Field by, Field bz, const Affine& map);

  Field base_x_, base_y_, base_z_;
  Affine here_from_base_;
  Box within_ = Box::everything();
};

}  // namespace ombre::program
