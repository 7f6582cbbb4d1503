// Writes a program's instructions into a builder, so that a pass can change some on the way.
#pragma once

#include <array>
#include <functional>

#include "program/field.h"

namespace ombre::program {

// The field to take for an instruction, given those of the instructions before it; nothing: a copy.
using Rewrite = std::function<std::optional<Field>(ValueId id, const std::vector<Field>& done)>;

// What passes work in. Kept from program to program, it saves allocating.
struct Workspace {
  Builder builder;
  std::vector<Field> fields;
  Outputs outputs;
};

// One field for each instruction. `program` may not hold calls.
std::vector<Field> replay(Builder& builder, const Program& program, const std::array<Field, 3>& inputs,
                          const Rewrite& rewrite = nullptr);

// The program with some instructions replaced, without what nothing needs any more. `rewrite` works with
// the workspace's builder, which is empty before.
void rewrite(const Program& program, Workspace& workspace, const Rewrite& rewrite, Program& result);

// The same by a class with a constructor from program and builder, and a method `rewrite` as above.
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

// Which of x, y, z (bits 1, 2, 4) each instruction depends on.
std::vector<uint8_t> axis_masks(const Program& program);

}  // namespace ombre::program
