// Recognises operands that are affine in (x, y, z), so that sources can be placed on voxel rows.
#include "program/passes/passes.h"

namespace ombre::program {
namespace {

// coefficients of x, y, z and one
std::optional<AffineRow> affine_form(const Program& program, ValueId id, std::span<const ValueId> base) {
  const Instruction& in = program.code[id];
  const auto form = [&](ValueId operand) { return affine_form(program, operand, base); };
  const auto unit = [](size_t axis) {
    AffineRow row{};
    row[axis] = 1;
    return row;
  };
  const auto combine = [](const AffineRow& a, double fa, const AffineRow& b, double fb) {
    AffineRow row;
    for (int i = 0; i < 4; ++i) row[i] = fa * a[i] + fb * b[i];
    return row;
  };
  const auto is_constant = [](const AffineRow& row) { return row[0] == 0 && row[1] == 0 && row[2] == 0; };
  for (size_t axis = 0; axis < base.size(); ++axis)
    if (id == base[axis]) return unit(axis);
  switch (in.op) {
    case Op::input:
      if (!base.empty()) return std::nullopt;
      return unit(static_cast<size_t>(in.value));
    case Op::constant:
      return AffineRow{0, 0, 0, in.value};
    case Op::negate: {
      const auto a = form(in.a);
      if (!a) return std::nullopt;
      return combine(*a, -1, *a, 0);
    }
    case Op::add:
    case Op::subtract:
    case Op::multiply: {
      const auto a = form(in.a), b = form(in.b);
      if (!a || !b) return std::nullopt;
      if (in.op == Op::add) return combine(*a, 1, *b, 1);
      if (in.op == Op::subtract) return combine(*a, 1, *b, -1);
      if (is_constant(*a)) return combine(*b, (*a)[3], *b, 0);
      if (is_constant(*b)) return combine(*a, (*b)[3], *a, 0);
      return std::nullopt;
    }
    case Op::affine: {
      const auto a = form(in.a), b = form(in.b), c = form(in.c);
      if (!a || !b || !c) return std::nullopt;
      const AffineRow& m = program.maps[in.aux];
      AffineRow row = combine(combine(*a, m[0], *b, m[1]), 1, *c, m[2]);
      row[3] += m[3];
      return row;
    }
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Affine> affine_operands(const Program& program, const Instruction& instruction,
                                      std::span<const ValueId> base) {
  Affine map;
  const ValueId ids[] = {instruction.a, instruction.b, instruction.c};
  for (int i = 0; i < 3; ++i) {
    const auto row = affine_form(program, ids[i], base);
    if (!row) return std::nullopt;
    map.rows[i] = {(*row)[0], (*row)[1], (*row)[2]};
    map.offset[i] = (*row)[3];
  }
  return map;
}

}  // namespace ombre::program
