// Functions that evaluate ops on rows of floats, for each op, instruction set and shape of operands.
//
// All instruction sets give the same bits. NaN means that the double-precision reference must decide; program/single.h
// describes how it propagates.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "base/math/interval.h"
#include "eval/batch/kernel_types.h"
#include "program/ops.h"

namespace ombre::eval {

struct KernelSet {
  std::string_view name;  // "avx512", "avx2" or "portable"
  Kernel (*kernel)(program::Op op, unsigned shape, Unknowns unknowns);
  // Writes the sine to `a_out` and the cosine to `b_out`. Results are bit-identical to those of the separate kernels.
  void (*sine_cosine)(const float* a, float* a_out, float* b_out, size_t count);
  IntervalKernel (*interval_kernel)(program::Op op);  // null for ops that are evaluated one interval at a time
  // Returns the hull of the intervals where `chosen` is not 0, or [inf, -inf] if there are none.
  Interval (*hull)(IntervalRow row, const float* chosen, size_t count);
};

// Returns the kernel sets that this machine can run, the fastest first. Empty without hardware multiply-add.
const std::vector<KernelSet>& kernel_sets();

}  // namespace ombre::eval
