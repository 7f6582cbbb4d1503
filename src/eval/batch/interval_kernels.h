// One function for each op and instruction set, on rows of intervals.
//
// What comes out encloses what float batches compute on any operands inside; the ends are floats. All instruction
// sets give the same bits.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "program/ops.h"

namespace ombre::eval {

// Lower and upper ends; as long as rows of batches.
struct IntervalRow {
  float* lo = nullptr;
  float* hi = nullptr;
};

using IntervalKernel = void (*)(IntervalRow a, IntervalRow b, IntervalRow c, IntervalRow out, size_t count);

struct IntervalKernelSet {
  std::string_view name;
  IntervalKernel (*kernel)(program::Op op);  // null for ops that are done one by one
  // Of the intervals where `chosen` is not 0; [inf, -inf] if there are none.
  Interval (*hull)(IntervalRow row, const float* chosen, size_t count);
};

// What this machine can run, best first; empty without hardware multiply-add.
const std::vector<IntervalKernelSet>& interval_kernel_sets();

}  // namespace ombre::eval
