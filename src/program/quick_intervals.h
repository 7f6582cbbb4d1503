// Inlined interval versions of the most frequent ops, since tiles evaluate them millions of times.
#pragma once

#include "program/ops.h"

namespace ombre::program {

// Returns NaN if the general functions have to compute the result. `round` rounds as the evaluator does.
template <class Round>
Interval quick_interval(Op op, Interval a, Interval b, Round round) {
  const Interval undecided(std::numeric_limits<double>::quiet_NaN());
  const auto rounded = [&](double lo, double hi) { return Interval(round(lo), round(hi)); };
  if (!a.is_bounded()) return undecided;
  switch (op) {
    case Op::square: {
      const double lo = a.lo > 0 ? a.lo : a.hi < 0 ? -a.hi : 0, hi = std::max(-a.lo, a.hi);
      return rounded(lo * lo, hi * hi);
    }
    case Op::abs:
      return {a.lo > 0 ? a.lo : a.hi < 0 ? -a.hi : 0, std::max(-a.lo, a.hi)};
    case Op::negate:
      return {-a.hi, -a.lo};
    default:
      break;
  }
  if (!b.is_bounded()) return undecided;
  switch (op) {
    case Op::add:
      return rounded(a.lo + b.lo, a.hi + b.hi);
    case Op::subtract:
      return rounded(a.lo - b.hi, a.hi - b.lo);
    case Op::multiply: {
      const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
      return rounded(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
    }
    case Op::min:
      return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
    case Op::max:
      return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
    case Op::less_equal:
      return a.hi <= b.lo ? Interval(1) : a.lo > b.hi ? Interval(0) : Interval(0, 1);
    default:
      return undecided;
  }
}

}  // namespace ombre::program
