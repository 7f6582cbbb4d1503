// Copies an instruction's table entries from one program to another.
#pragma once

#include "program/program.h"

namespace ombre::program {

// Copies the table entry in `from` that the instruction's aux refers to into `to`, and updates aux.
inline void copy_tables(const Program& from, Program& to, Instruction& in) {
  const auto copy = [&](const auto& source, auto& target) {
    target.push_back(source[in.aux]);
    in.aux = static_cast<uint32_t>(target.size() - 1);
  };
  if (in.op == Op::affine) copy(from.maps, to.maps);
  if (in.op == Op::source) copy(from.reads, to.reads);
  if (in.op == Op::call) copy(from.calls, to.calls);
  if (in.op == Op::parts) copy(from.part_sets, to.part_sets);
}

}  // namespace ombre::program
