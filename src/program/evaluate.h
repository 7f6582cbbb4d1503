// Evaluation of each instruction of a program, at a point or over a box.
#pragma once

#include <vector>

#include "program/program.h"

namespace ombre::program {

// Returns an interval that encloses the result of an arithmetic instruction whose operands lie in the given intervals.
Interval apply_interval(const Instruction& in, Interval a, Interval b, Interval c, Precision precision);

// Computes an interval for each instruction over a box of inputs. It encloses the rounded value at every point. `code`
// may not hold calls. program/single.h describes the intervals of batches.
void evaluate_intervals(const Program& program, const Box& box, std::vector<Interval>& values,
                        const SourceRanges& source_ranges = nullptr, Precision precision = Precision::reference);

// Computes the value of each instruction at a point in double precision; this is the reference. The program may not
// hold calls or parts.
void evaluate_point(const Program& program, Vec3 p, std::vector<double>& values);

}  // namespace ombre::program
