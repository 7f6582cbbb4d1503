// Detects operands that are affine in (x, y, z), so that sources can be sampled along rows of voxels.
#include "program/passes/affine_form.h"
#include "program/passes/passes.h"

namespace ombre::program {
namespace {

std::optional<AffineRow> form_of(const Program& program, ValueId id, std::span<const ValueId> base) {
  for (size_t axis = 0; axis < base.size(); ++axis)
    if (id == base[axis]) return unit_form(axis);
  const Instruction& in = program.code[id];
  if (in.op == Op::input && !base.empty()) return std::nullopt;
  return affine_form(program, in, [&](ValueId operand) { return form_of(program, operand, base); });
}

}  // namespace

std::optional<Affine> affine_operands(const Program& program, const Instruction& instruction,
                                      std::span<const ValueId> base) {
  Affine map;
  const ValueId ids[] = {instruction.a, instruction.b, instruction.c};
  for (int i = 0; i < 3; ++i) {
    const auto row = form_of(program, ids[i], base);
    if (!row) return std::nullopt;
    map.rows[i] = {(*row)[0], (*row)[1], (*row)[2]};
    map.offset[i] = (*row)[3];
  }
  return map;
}

}  // namespace ombre::program
