// Detection of values that are affine in the inputs.
#pragma once

#include <optional>

#include "program/program.h"

namespace ombre::program {

inline bool is_constant(const AffineRow& form) { return form[0] == 0 && form[1] == 0 && form[2] == 0; }

inline AffineRow unit_form(size_t axis) {
  AffineRow form{};
  form[axis] = 1;
  return form;
}

// Returns the factors of x, y and z and the constant term of an instruction's value, if it is affine. form_of(operand)
// returns those of an operand, or nothing.
template <class FormOf>
std::optional<AffineRow> affine_form(const Program& program, const Instruction& in, const FormOf& form_of) {
  const auto combine = [](const AffineRow& a, double fa, const AffineRow& b, double fb) {
    AffineRow form;
    for (size_t n = 0; n < form.size(); ++n) form[n] = fa * a[n] + fb * b[n];
    return form;
  };
  switch (in.op) {
    case Op::input:
      return unit_form(static_cast<size_t>(in.value));
    case Op::constant:
      return AffineRow{0, 0, 0, in.value};
    case Op::negate: {
      const std::optional<AffineRow> a = form_of(in.a);
      if (!a) return std::nullopt;
      return combine(*a, -1, *a, 0);
    }
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::fma: {
      const std::optional<AffineRow> a = form_of(in.a), b = form_of(in.b);
      const std::optional<AffineRow> c = in.op == Op::fma ? form_of(in.c) : AffineRow{};
      if (!a || !b || !c) return std::nullopt;
      if (in.op == Op::add) return combine(*a, 1, *b, 1);
      if (in.op == Op::subtract) return combine(*a, 1, *b, -1);
      if (is_constant(*a)) return combine(*b, (*a)[3], *c, 1);
      if (is_constant(*b)) return combine(*a, (*b)[3], *c, 1);
      return std::nullopt;
    }
    case Op::affine: {
      const std::optional<AffineRow> a = form_of(in.a), b = form_of(in.b), c = form_of(in.c);
      if (!a || !b || !c) return std::nullopt;
      const AffineRow& m = program.maps[in.aux];
      AffineRow form = combine(combine(*a, m[0], *b, m[1]), 1, *c, m[2]);
      form[3] += m[3];
      return form;
    }
    default:
      return std::nullopt;
  }
}

}  // namespace ombre::program
