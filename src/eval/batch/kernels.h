// One function for each op, instruction set and shape of operands: float rows in, float rows out.
//
// All instruction sets give the same bits. NaN stands for "ask the reference"; program/single.h says
// how it spreads.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "base/math/interval.h"
#include "eval/batch/kernel_types.h"
#include "program/ops.h"

namespace ombre::eval {

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
