// The value of each instruction of a program, at a point or over a box.
#pragma once

#include <vector>

#include "program/program.h"

namespace ombre::program {

// Of an arithmetic instruction whose operands are in these intervals.
Interval apply_interval(const Instruction& in, Interval a, Interval b, Interval c, Precision precision);

// The value of each instruction over a box of inputs; encloses every point's rounded value.
// `code` may not hold calls. For batches see program/single.h.
void evaluate_intervals(const Program& program, const Box& box, std::vector<Interval>& values,
                        const SourceRanges& source_ranges = nullptr, Precision precision = Precision::reference);

// Value of each instruction at a point, in double precision: the reference. Without calls and parts.
void evaluate_point(const Program& program, Vec3 p, std::vector<double>& values);

}  // namespace ombre::program
