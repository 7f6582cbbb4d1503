// Fields: expressions over space under construction. Equal expressions become one.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "program/program.h"

namespace ombre::program {

class Builder;

// A handle to a value in a builder; cheap to copy, valid as long as its builder.
struct Field {
  Builder* builder = nullptr;
  ValueId id = 0;

  explicit operator bool() const { return builder != nullptr; }
  bool operator==(const Field&) const = default;
};

using Outputs = std::vector<std::pair<std::string, Field>>;

// Whoever fills a builder may leave itself here, to be found by what only has a point of the builder's.
class BuilderUser {
 public:
  virtual ~BuilderUser() = default;
};

// Builds programs. Shares equal subexpressions and folds constants as they are made.
class Builder {
 public:
  Builder();
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  Field input(int axis) { return {this, static_cast<ValueId>(axis)}; }
  Field constant(double value);
  Field apply(Op op, Field a, Field b = {}, Field c = {});
  Field affine(const AffineRow& row, Field a, Field b, Field c);
  Field source(const SourceField& source, int channel, Field a, Field b, Field c, uint32_t tag = 0);
  // `body` may still grow; its outputs are numbered in the order in which they were added.
  Field call(const std::shared_ptr<Program>& body, uint32_t output, Field a, Field b, Field c);

  // Slot of many parts.
  Field parts(const std::shared_ptr<const PartSet>& set, size_t slot, Field a, Field b, Field c);

  std::optional<double> constant_value(Field field) const;
  const Instruction& instruction(Field field) const { return code_[field.id]; }
  const AffineRow& affine_row(Field field) const { return maps_[code_[field.id].aux]; }  // of an affine map
  bool is_truth(Field field) const;                                                      // is its value always 0 or 1?
  size_t size() const { return code_.size(); }
  // Forgets everything but its memory and its user, for another program.
  void clear();
  BuilderUser* user() const { return user_; }  // null: there is none
  void set_user(BuilderUser* user) { user_ = user; }

  // What the outputs need, in the order of construction; nothing else.
  Program finish(const Outputs& outputs) const;
  // The same in place of what `program` was, whose memory it takes.
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
  std::vector<Key> keys_;       // of the instructions
  std::vector<ValueId> table_;  // instructions by the hashes of their keys; 0, an input, where there is none
};

// Arithmetic on fields; a number stands for a constant.
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
Field ceil(Field a);
Field sin(Field a);
Field cos(Field a);
Field length(Field a, Field b);
Field length(Field a, Field b, Field c);
// Integer powers become products.
Field power(Field base, Field exponent);
// Truth values, 0 or 1.
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
// Folds a list pairwise, as a balanced tree, so that a part of it can be settled alone.
Field fold(std::vector<Field> fields, Field (*combine)(Field, Field));
Field sum(std::vector<Field> fields);

// A point at which nodes are evaluated: an affine image of a base point whose coordinates are fields.
class Point {
 public:
  Field x, y, z;
  // Indices of the cell that the point was brought back from, where space repeats; else no fields.
  std::array<Field, 3> cell;

  // The point of a whole program or body.
  static Point origin_frame(Builder& builder);
  // A point of three fields, as a new base.
  static Point of(Field x, Field y, Field z) { return {x, y, z, Affine{}}; }
  // The point that `map` takes this one to.
  Point mapped(const Affine& map) const;
  // A point of three fields that keeps what this one knows besides its place.
  Point moved_to(Field to_x, Field to_y, Field to_z) const;
  // Where the point is known to lie; a box without end where nothing is known.
  const Box& within() const { return within_; }
  void set_within(const Box& box) { within_ = box; }
  // The map that takes the builder's inputs to this point, if an affine one does.
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
