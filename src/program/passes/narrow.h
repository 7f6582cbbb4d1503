// Specialisation of a program to a region.
#pragma once

#include "program/passes/passes.h"

namespace ombre::program {

struct Remainder {
  Program program;
  std::vector<Interval> ranges;  // range of each instruction in the region
};

// Returns the program for inputs in a box. Values that are constant there become constants, and instructions that
// cannot affect the outputs are removed. Results stay bit-identical. An instruction that may be NaN in the box is not
// replaced, so NaN stays NaN.
Remainder narrow(const Program& program, const Box& box, Precision precision = Precision::reference,
                 const SourceRanges& source_ranges = nullptr);

// Returns the program for inputs in a box, with many parts replaced by the code of those that reach it.
Program narrow_to_parts(const Program& program, const Box& box, Precision precision = Precision::reference,
                        const SourceRanges& source_ranges = nullptr);

}  // namespace ombre::program
