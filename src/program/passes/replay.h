// Copies a program's instructions into a builder, so that a pass can replace some of them.
#pragma once

#include <array>
#include <functional>

#include "program/field.h"

namespace ombre::program {

// Returns the field that replaces an instruction, given the fields of all earlier instructions, or nothing to copy the
// instruction.
using Rewrite = std::function<std::optional<Field>(ValueId id, const std::vector<Field>& done)>;

// Buffers of passes, reused between programs to avoid allocations.
struct Workspace {
  Builder builder;
  std::vector<Field> fields;
  Outputs outputs;
};

// Returns one field for each instruction. `program` may not hold calls.
std::vector<Field> replay(Builder& builder, const Program& program, const std::array<Field, 3>& inputs,
                          const Rewrite& rewrite = nullptr);

// Replaces some instructions of a program and removes those that are no longer needed. `rewrite` uses the workspace's
// builder, which must be empty at the start.
void rewrite(const Program& program, Workspace& workspace, const Rewrite& rewrite, Program& result);

// Rewrites a program with a class that has a constructor from program and builder and a method `rewrite` as above.
template <class Pass>
void rewrite_by(const Program& program, Workspace& workspace, Program& result) {
  workspace.builder.clear();
  Pass pass(program, workspace.builder);
  rewrite(
      program, workspace, [&](ValueId id, const std::vector<Field>& done) { return pass.rewrite(id, done); }, result);
}
template <class Pass>
Program rewritten_by(const Program& program) {
  Workspace workspace;
  Program result;
  rewrite_by<Pass>(program, workspace, result);
  return result;
}

// Returns for each instruction the axes on which it depends, as bits: 1 for x, 2 for y, 4 for z.
std::vector<uint8_t> axis_masks(const Program& program);

}  // namespace ombre::program
