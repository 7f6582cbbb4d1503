#include "surface/cells/shortened.h"

#include "program/passes/narrow.h"

namespace ombre::surface {

program::Program shortened_for(const program::Program& details, const Box& box, size_t many) {
  program::Remainder left = program::narrow(details, box);
  const auto has_many = [&] { return program::parts_in_reach(left.program, left.ranges, many) >= many; };
  if (!left.program.has_parts() || (many != all_parts && has_many())) return std::move(left.program);
  return program::expand_parts(left.program, left.ranges, program::Precision::reference);
}

}  // namespace ombre::surface
