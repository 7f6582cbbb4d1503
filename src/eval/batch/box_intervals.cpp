#include "eval/batch/box_intervals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/assert.h"
#include "program/evaluate.h"
#include "program/parts.h"

namespace ombre::eval {

using program::Instruction;
using program::Op;
using program::ValueId;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
// Up to this many pieces of parts are compared with all boxes. With more, the index is queried for each box.
constexpr size_t few_pieces = 256;

struct Ends {
  float lo, hi;
};

void meet(const IntervalRow& row, Ends piece, std::vector<int32_t>& meets) {
  for (size_t n = 0; n < meets.size(); ++n)
    meets[n] &= static_cast<int32_t>(row.lo[n] <= piece.hi) & static_cast<int32_t>(row.hi[n] >= piece.lo);
}

// True for x / x, whose range is narrower than what the intervals of two different operands would give.
bool is_own_quotient(const Instruction& in) { return in.a == in.b && (in.op == Op::divide || in.op == Op::share); }

}  // namespace

BoxIntervals::BoxIntervals(const KernelSet& kernels) : kernels_(kernels) {
  for (size_t op = 0; op < by_op_.size(); ++op) by_op_[op] = kernels.interval_kernel(static_cast<Op>(op));
}

void BoxIntervals::evaluate(const program::Program& program, std::span<const Box> boxes, const SourceRanges& sources) {
  program_ = &program;
  count_ = boxes.size();
  stride_ = padded(count_);
  reserve(program.code.size());
  for (ValueId id = 0; id < program.code.size(); ++id) {
    const Instruction& in = program.code[id];
    const IntervalKernel kernel = by_op_[static_cast<size_t>(in.op)];
    if (kernel && !is_own_quotient(in))
      kernel(row(in.a), row(in.b), row(in.c), row(id), stride_);
    else
      evaluate_alone(id, boxes, sources);
  }
}

void BoxIntervals::reserve(size_t instructions) {
  const size_t floats = stride_ * (2 * instructions + 1) + batch_lanes;
  if (memory_.size() < floats) memory_.resize(floats);
  const auto address = reinterpret_cast<uintptr_t>(memory_.data());
  constexpr uintptr_t alignment = batch_lanes * sizeof(float);
  floats_ = memory_.data() + (alignment - address % alignment) % alignment / sizeof(float);
}

template <class F>
void BoxIntervals::fill(ValueId id, F value_of) {
  const IntervalRow to = row(id);
  for (size_t n = 0; n < count_; ++n) {
    const Interval value = value_of(n);
    to.lo[n] = static_cast<float>(value.lo);
    to.hi[n] = static_cast<float>(value.hi);
  }
  pad(to);
}

void BoxIntervals::pad(IntervalRow row) {
  std::fill(row.lo + count_, row.lo + stride_, row.lo[count_ - 1]);
  std::fill(row.hi + count_, row.hi + stride_, row.hi[count_ - 1]);
}

Box BoxIntervals::Place::in(size_t box) const {
  const auto end = [&](size_t axis, float* IntervalRow::*which) {
    return static_cast<double>((rows[axis].*which)[box]);
  };
  return {{end(0, &IntervalRow::lo), end(1, &IntervalRow::lo), end(2, &IntervalRow::lo)},
          {end(0, &IntervalRow::hi), end(1, &IntervalRow::hi), end(2, &IntervalRow::hi)}};
}

void BoxIntervals::evaluate_alone(ValueId id, std::span<const Box> boxes, const SourceRanges& sources) {
  const Instruction& in = program_->code[id];
  switch (in.op) {
    case Op::input:
      return fill(id, [&](size_t box) { return boxes[box].axis(static_cast<int>(in.value)); });
    case Op::constant: {
      const bool is_known = !std::isnan(in.value);
      const auto value = static_cast<float>(in.value);
      const IntervalRow to = row(id);
      std::fill_n(to.lo, stride_, is_known ? value : -inf);
      std::fill_n(to.hi, stride_, is_known ? value : inf);
      return;
    }
    case Op::source:
      sources(program_->reads[in.aux], operands(in), row(id));
      return pad(row(id));
    case Op::parts:
      return query_parts(id);
    case Op::affine:
    case Op::call:
      ASSERT(false && "calls are inlined and maps written out before evaluation in batches");
      return;
    default:
      return fill(id, [&](size_t box) {
        return apply_interval(in, value(in.a, box), value(in.b, box), value(in.c, box), program::Precision::batch);
      });
  }
}

// Queries the index once for consecutive slots of one set at one place.
void BoxIntervals::query_parts(ValueId id) {
  const Instruction& in = program_->code[id];
  const program::PartSet& set = *program_->part_sets[in.aux];
  const auto is_same_query = [&](const Instruction& other) {
    const bool is_there = other.a == in.a && other.b == in.b && other.c == in.c;
    return other.op == Op::parts && is_there && program_->part_sets[other.aux].get() == &set;
  };
  if (id == 0 || !is_same_query(program_->code[id - 1])) find_reached(set.index, in);
  const Interval range = set.ranges[static_cast<size_t>(in.value)];
  fill(id, [&](size_t box) { return reached_[box] ? range : Interval(0); });
}

// Finds the boxes that parts reach. Neighbouring boxes have few pieces near them, so each piece is compared with all
// boxes. Its ends are rounded to nearest, since boxes of parts are grown by more than that rounding (program/parts.h).
void BoxIntervals::find_reached(const program::PartIndex& index, const Instruction& in) {
  const Place place = operands(in);
  Box around = place.in(0);
  for (size_t box = 1; box < count_; ++box) around = hull(around, place.in(box));
  reached_.assign(stride_, 0);
  if (!index.find_few(around, few_pieces, near_)) {
    for (size_t box = 0; box < count_; ++box) reached_[box] = index.reaches(place.in(box)) ? 1 : 0;
    return;
  }
  for (const program::PartIndex::Entry& entry : near_) {
    meets_.assign(stride_, 1);
    for (size_t axis = 0; axis < 3; ++axis) {
      const Interval piece = entry.box.axis(static_cast<int>(axis));
      meet(place.rows[axis], {static_cast<float>(piece.lo), static_cast<float>(piece.hi)}, meets_);
    }
    for (size_t n = 0; n < stride_; ++n) reached_[n] |= meets_[n];
  }
}

void BoxIntervals::values(size_t box, std::vector<Interval>& values) const {
  values.resize(program_->code.size());
  for (ValueId id = 0; id < values.size(); ++id) values[id] = value(id, box);
}

void BoxIntervals::values(std::span<const size_t> boxes, std::vector<Interval>& values) {
  std::fill_n(chosen(), stride_, 0.0F);
  for (const size_t box : boxes) chosen()[box] = 1;
  values.resize(program_->code.size());
  for (ValueId id = 0; id < values.size(); ++id) {
    const bool is_constant = program_->code[id].op == Op::constant;
    values[id] = is_constant ? value(id, 0) : kernels_.hull(row(id), chosen(), stride_);
  }
}

}  // namespace ombre::eval
