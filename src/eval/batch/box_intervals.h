// Evaluates a program's intervals over many boxes at once with SIMD, as evaluate_intervals does for one box.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "eval/batch/kernels.h"
#include "program/parts.h"
#include "program/program.h"

namespace ombre::eval {

class BoxIntervals {
 public:
  // The ranges of the operands at which a source is evaluated.
  struct Place {
    std::array<IntervalRow, 3> rows;
    Box in(size_t box) const;
  };
  // Writes the range of a source for each box to `to`, which has one interval per box.
  using SourceRanges = std::function<void(const program::Read&, const Place& at, IntervalRow to)>;

  explicit BoxIntervals(const KernelSet& kernels);

  // Computes intervals that enclose the results of float batches (program/single.h). `program` may not hold calls or
  // affine maps, and must outlive later queries. Results equal those of evaluate_intervals, except that sine, cosine,
  // atan2 and exp are about 1e-6 wider.
  void evaluate(const program::Program& program, std::span<const Box> boxes, const SourceRanges& sources);
  Interval output(size_t n, size_t box) const { return value(program_->outputs[n], box); }
  // Returns the range of each instruction over one box, or the hull over several.
  void values(size_t box, std::vector<Interval>& values) const;
  void values(std::span<const size_t> boxes, std::vector<Interval>& values);

 private:
  size_t place(program::ValueId id) const { return 2 * stride_ * id; }
  IntervalRow row(program::ValueId id) { return {floats_ + place(id), floats_ + place(id) + stride_}; }
  float* chosen() { return floats_ + 2 * program_->code.size() * stride_; }
  Interval value(program::ValueId id, size_t box) const {
    const float* lo = floats_ + place(id) + box;
    return {static_cast<double>(*lo), static_cast<double>(lo[stride_])};
  }
  Place operands(const program::Instruction& in) { return {{row(in.a), row(in.b), row(in.c)}}; }
  void reserve(size_t instructions);
  template <class F>
  void fill(program::ValueId id, F value_of);  // box by box
  void pad(IntervalRow row);                   // repeats the last box
  void evaluate_alone(program::ValueId id, std::span<const Box> boxes, const SourceRanges& sources);
  void query_parts(program::ValueId id);
  void find_reached(const program::PartIndex& index, const program::Instruction& place);

  const KernelSet& kernels_;
  std::array<IntervalKernel, program::op_table.size()> by_op_{};  // null for ops that are evaluated box by box
  const program::Program* program_ = nullptr;
  size_t count_ = 0, stride_ = 0;  // number of boxes; floats from row to row
  std::vector<float> memory_;
  // The lower ends and then the upper ends of each instruction; after these, flags of chosen boxes.
  float* floats_ = nullptr;
  std::vector<int32_t> reached_, meets_;  // one flag per box, set if parts reach it, for the last `parts` instruction
  std::vector<program::PartIndex::Entry> near_;
};

}  // namespace ombre::eval
