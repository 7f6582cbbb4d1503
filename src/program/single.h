// Intervals that enclose what float batches compute.
//
// In a batch, NaN means "ask the reference": it arises where a float runs out of range or the value is
// not a number, and it stays wherever it matters, in comparisons and truth values too. So a lane that
// ends as NaN is redone in double precision, and which lanes these are does not depend on how a program
// was shortened. Here, everything() says that a value may be NaN.
#pragma once

#include "program/ops.h"

namespace ombre::program {

// Sine and cosine of greater arguments are NaN in batches.
constexpr double batch_trigonometric_limit = 30000;
// Bounds the error of the batches' sine and cosine up to there.
constexpr double batch_trigonometric_error = 0x1p-22;

// Rounded to the nearest floats, which keeps the order.
Interval to_single(Interval v);

// Operands with ends that are floats. Sums, products, quotients, roots and fused multiply-adds are
// correctly rounded and enclosed tightly; elementary functions are widened by their error.
Interval apply_single(Op op, Interval a, Interval b, Interval c);

}  // namespace ombre::program
