// Evaluates a program's intervals over many boxes at once: what evaluate_intervals does for one, with SIMD.
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
  // The operands' ranges that a source is evaluated at.
  struct Place {
    std::array<IntervalRow, 3> rows;
    Box in(size_t box) const;
  };
  // Fills `to`, as long as the boxes, with what a source can be at a place in each of them.
  using SourceRanges = std::function<void(const program::Read&, const Place& at, IntervalRow to)>;

  explicit BoxIntervals(const KernelSet& kernels);

  // The values enclose what float batches compute (program/single.h). `program` without calls and affine maps; it
  // must outlive the questions. Equal to evaluate_intervals, but for sine, cosine, atan2 and exp, which are some 1e-6
  // wider.
  void evaluate(const program::Program& program, std::span<const Box> boxes, const SourceRanges& sources);
  Interval output(size_t n, size_t box) const { return value(program_->outputs[n], box); }
  // Of each instruction: over one box, or the hull over some.
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
  std::array<IntervalKernel, program::op_table.size()> by_op_{};  // null for what is done box by box
  const program::Program* program_ = nullptr;
  size_t count_ = 0, stride_ = 0;  // boxes; floats from row to row
  std::vector<float> memory_;
  float* floats_ = nullptr;               // for each instruction the lower ends, then the upper ones; then flags
  std::vector<int32_t> reached_, meets_;  // by box: do parts reach it? Of the last `parts` instruction
  std::vector<program::PartIndex::Entry> near_;
};

}  // namespace ombre::eval
