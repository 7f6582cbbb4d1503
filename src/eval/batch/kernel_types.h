// The functions that evaluate one op on rows of floats, or of intervals.
#pragma once

#include <cstddef>

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

// Computes intervals that enclose what a Kernel computes on any operands inside; their ends are floats.
using IntervalKernel = void (*)(IntervalRow a, IntervalRow b, IntervalRow c, IntervalRow out, size_t count);

}  // namespace ombre::eval
