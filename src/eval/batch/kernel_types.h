// Types of functions that evaluate one op on rows of floats or intervals.
#pragma once

#include <cstddef>

namespace ombre::eval {

// Rows are padded to a multiple of this many floats. Kernels compute the padding, too.
constexpr size_t batch_lanes = 16;
constexpr size_t padded(size_t count) { return (count + batch_lanes - 1) / batch_lanes * batch_lanes; }

// Computes out[n] = op(a[n], b[n], c[n]). An operand that is one number for the whole row is read only at [0].
using Kernel = void (*)(const float* a, const float* b, const float* c, float* out, size_t count);

enum OperandShape : unsigned { all_rows = 0, a_is_number = 1, b_is_number = 2, c_is_number = 4 };

// Says whether operands may be NaN. Kernels for `never` are faster, and otherwise equal.
enum class Unknowns { never, possible };

// Lower and upper ends of a row of intervals, each padded like a row of floats.
struct IntervalRow {
  float* lo = nullptr;
  float* hi = nullptr;
};

// Computes intervals that enclose the results of a Kernel for all operands in the intervals. Their ends are floats.
using IntervalKernel = void (*)(IntervalRow a, IntervalRow b, IntervalRow c, IntervalRow out, size_t count);

}  // namespace ombre::eval
