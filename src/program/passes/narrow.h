// What is left of a program in a region.
#pragma once

#include "program/passes/passes.h"

namespace ombre::program {

struct Remainder {
  Program program;
  std::vector<Interval> ranges;  // of its instructions, in the region
};

// The program for inputs in a box: what is settled there is a constant, what cannot matter is left out. What is left
// has the same values, to the last bit. An instruction that may be NaN in the box is not settled, so NaN stays NaN.
Remainder narrow(const Program& program, const Box& box, Precision precision = Precision::reference,
                 const SourceRanges& source_ranges = nullptr);

// The same, with the code of those of many parts that reach the box.
Program narrow_to_parts(const Program& program, const Box& box, Precision precision = Precision::reference,
                        const SourceRanges& source_ranges = nullptr);

}  // namespace ombre::program
