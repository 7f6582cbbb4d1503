// One function for each op, instruction set and shape of operands: float rows in, float rows out.
//
// All instruction sets give the same bits. NaN stands for "ask the reference"; program/single.h says
// how it spreads.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "program/ops.h"

namespace ombre::eval {

// Rows are padded to a multiple of this many floats; kernels compute the padding too.
constexpr size_t batch_lanes = 16;
constexpr size_t padded(size_t count) { return (count + batch_lanes - 1) / batch_lanes * batch_lanes; }

// out[n] = op(a[n], b[n], c[n]). An operand that is one number for the whole row is read at [0] only.
using Kernel = void (*)(const float* a, const float* b, const float* c, float* out, size_t count);

enum OperandShape : unsigned { all_rows = 0, a_is_number = 1, b_is_number = 2, c_is_number = 4 };

// Can operands be NaN? Kernels for `never` are faster and equal otherwise.
enum class Unknowns { never, possible };

// Lower and upper ends of intervals, as long as rows of floats.
struct IntervalRow {
  float* lo = nullptr;
  float* hi = nullptr;
};

// What comes out encloses what a Kernel computes on any operands inside; the ends are floats.
using IntervalKernel = void (*)(IntervalRow a, IntervalRow b, IntervalRow c, IntervalRow out, size_t count);

struct KernelSet {
  std::string_view name;  // "avx512", "avx2", "portable"
  Kernel (*kernel)(program::Op op, unsigned shape, Unknowns unknowns);
  // sine to `a_out`, cosine to `b_out`, with the bits of the separate kernels
  void (*sine_cosine)(const float* a, float* a_out, float* b_out, size_t count);
  IntervalKernel (*interval_kernel)(program::Op op);  // null for ops that are done one by one
  // Of the intervals where `chosen` is not 0; [inf, -inf] if there are none.
  Interval (*hull)(IntervalRow row, const float* chosen, size_t count);
};

// What this machine can run, best first; empty without hardware multiply-add.
const std::vector<KernelSet>& kernel_sets();

}  // namespace ombre::eval
