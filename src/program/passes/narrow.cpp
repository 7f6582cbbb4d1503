#include "program/passes/narrow.h"

#include "program/evaluate.h"

namespace ombre::program {

Remainder narrow(const Program& program, const Box& box, Precision precision, const SourceRanges& source_ranges) {
  std::vector<Interval> values;
  evaluate_intervals(program, box, values, source_ranges, precision);
  Remainder left;
  left.program = shorten(program, values, &left.ranges);
  return left;
}

Program narrow_to_parts(const Program& program, const Box& box, Precision precision,
                        const SourceRanges& source_ranges) {
  Remainder left = narrow(program, box, precision, source_ranges);
  if (!left.program.has_parts()) return std::move(left.program);
  return expand_parts(left.program, left.ranges, precision);
}

}  // namespace ombre::program
