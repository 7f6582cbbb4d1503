// Intervals that enclose the results of float batches.
//
// In a batch, NaN means that the double-precision reference must decide. It arises where a float overflows or the value
// is not a number, and it propagates wherever it matters, also through comparisons and truth values. A lane that ends
// as NaN is recomputed in double precision. The set of these lanes does not depend on how a program was shortened.
// Here, everything() says that a value may be NaN.
#pragma once

#include "program/ops.h"

namespace ombre::program {

// Batches give NaN for the sine and cosine of greater arguments.
constexpr double batch_trigonometric_limit = 30000;
// Bounds the error of the batches' sine and cosine for arguments up to that limit.
constexpr double batch_trigonometric_error = 0x1p-22;

// Rounds the ends to the nearest floats, which preserves order.
Interval to_single(Interval v);

// Computes an interval for operands whose ends are floats. Sums, products, quotients, roots and fused multiply-adds are
// correctly rounded and enclosed tightly; elementary functions are widened by their error.
Interval apply_single(Op op, Interval a, Interval b, Interval c);

}  // namespace ombre::program
