// Ops on vectors of intervals. Included once for each instruction set.
//
// Results enclose the values that float batches compute for any operands in the intervals.

#if defined(OMBRE_EVAL_BATCH_INTERVALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMBRE_EVAL_BATCH_INTERVALS_INL_H_
#undef OMBRE_EVAL_BATCH_INTERVALS_INL_H_
#else
#define OMBRE_EVAL_BATCH_INTERVALS_INL_H_
#endif

#include <numbers>
#include <type_traits>

#include "eval/batch/kernel_types.h"
#include "eval/batch/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ombre::eval {
namespace HWY_NAMESPACE {
namespace intervals {

namespace hn = hwy::HWY_NAMESPACE;

using batch::D;
using batch::M;
using batch::number;
using batch::V;
using program::Op;

struct Ends {
  V lo, hi;
};

constexpr float inf = std::numeric_limits<float>::infinity();

// Uses the processor's minimum and maximum. The sign of zero does not matter here, and NaN does not occur.
HWY_INLINE V least(V a, V b) { return hn::Min(a, b); }
HWY_INLINE V most(V a, V b) { return hn::Max(a, b); }
HWY_INLINE V zero() { return hn::Zero(D()); }
HWY_INLINE M lacks_zero(Ends v) { return hn::Or(hn::Gt(v.lo, zero()), hn::Lt(v.hi, zero())); }
HWY_INLINE M is_zero(Ends v) { return hn::And(hn::Eq(v.lo, zero()), hn::Eq(v.hi, zero())); }
HWY_INLINE M is_bounded(Ends v) {
  return hn::And(hn::Lt(hn::Abs(v.lo), number(inf)), hn::Lt(hn::Abs(v.hi), number(inf)));
}
HWY_INLINE M is_everything(Ends v) { return hn::And(hn::Eq(v.lo, number(-inf)), hn::Eq(v.hi, number(inf))); }
HWY_INLINE Ends everything_where(M m, Ends otherwise) {
  return {hn::IfThenElse(m, number(-inf), otherwise.lo), hn::IfThenElse(m, number(inf), otherwise.hi)};
}
HWY_INLINE Ends truth_of(M surely, M never) { return {batch::one_where(surely), batch::one_where(hn::Not(never))}; }
// Returns the hull of the results at the four corners of two operands.
HWY_INLINE Ends around(V p, V q, V r, V s) { return {least(least(p, q), least(r, s)), most(most(p, q), most(r, s))}; }
HWY_INLINE Ends absolute(Ends v) {
  const V below = hn::Neg(v.hi);
  return {most(most(v.lo, below), zero()), most(hn::Neg(v.lo), v.hi)};
}

// True if v may contain phase + 2 pi n for some integer n; the tolerance errs towards true.
HWY_INLINE M meets(Ends v, float phase) {
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  const V slack = hn::Mul(number(2e-6F), hn::Add(number(1), most(hn::Abs(v.lo), hn::Abs(v.hi))));
  const V from = hn::Sub(hn::Sub(v.lo, slack), number(phase));
  const V n = hn::Ceil(hn::Div(from, number(turn)));
  return hn::Le(hn::Add(number(phase), hn::Mul(number(turn), n)), hn::Add(v.hi, slack));
}

// Returns the range of a wave of height 1 with crests at `crest` + 2 pi n. a and b are its values at the ends of v.
HWY_INLINE Ends wave(Ends v, V a, V b, float crest) {
  constexpr float half_turn = std::numbers::pi_v<float>;
  const V error = number(static_cast<float>(program::batch_trigonometric_error)), one = number(1);
  const V lo = hn::Sub(least(a, b), error), hi = hn::Add(most(a, b), error);
  const Ends met{hn::IfThenElse(meets(v, crest - half_turn), number(-1), most(lo, number(-1))),
                 hn::IfThenElse(meets(v, crest), one, least(hi, one))};
  const V limit = number(static_cast<float>(program::batch_trigonometric_limit));
  const M outside = hn::Or(hn::Gt(hn::Neg(limit), v.lo), hn::Gt(v.hi, limit));
  return everything_where(outside, met);
}

// Widens by more than the errors of two values of an elementary function.
HWY_INLINE Ends widened(Ends v) {
  const V share = number(0x1p-21F), least_float = number(std::numeric_limits<float>::min());
  const auto slack = [&](V end) { return batch::fma(hn::Abs(end), share, least_float); };
  return {hn::Sub(v.lo, slack(v.lo)), hn::Add(v.hi, slack(v.hi))};
}

HWY_INLINE Ends arc(Ends y, Ends x) {
  const M crosses_cut = hn::And(hn::Le(x.lo, zero()), hn::And(hn::Le(y.lo, zero()), hn::Ge(y.hi, zero())));
  const Ends corners = widened(
      around(batch::atan2(y.lo, x.lo), batch::atan2(y.lo, x.hi), batch::atan2(y.hi, x.lo), batch::atan2(y.hi, x.hi)));
  const V most_angle = number(0x1.921fb8p+1F);  // slightly above pi
  return {hn::IfThenElse(crosses_cut, hn::Neg(most_angle), corners.lo),
          hn::IfThenElse(crosses_cut, most_angle, corners.hi)};
}

// Never returns less than 0. Returns infinity a little below the largest float.
HWY_INLINE Ends exponential(Ends v) {
  const Ends wide = widened({batch::exp(v.lo), batch::exp(v.hi)});
  return {most(wide.lo, zero()), hn::IfThenElse(hn::Gt(wide.hi, number(0x1p126F)), number(inf), wide.hi)};
}

HWY_INLINE Ends fused(Ends a, Ends b, Ends c) {
  const auto corners = [&](V z) {
    return around(batch::fma(a.lo, b.lo, z), batch::fma(a.lo, b.hi, z), batch::fma(a.hi, b.lo, z),
                  batch::fma(a.hi, b.hi, z));
  };
  return {corners(c.lo).lo, corners(c.hi).hi};
}

HWY_INLINE Ends share(Ends part, Ends total) {
  const M surely = hn::Gt(total.lo, zero()), none = hn::Le(total.hi, zero());
  const V lo = hn::IfThenElse(hn::Ge(part.lo, zero()), hn::Div(part.lo, total.hi),
                              hn::IfThenElse(surely, hn::Div(part.lo, total.lo), number(-inf)));
  const V hi = hn::IfThenElse(hn::Le(part.hi, zero()), hn::Div(part.hi, total.hi),
                              hn::IfThenElse(surely, hn::Div(part.hi, total.lo), number(inf)));
  const Ends quotient{least(lo, number(1)), least(hi, number(1))};
  return {hn::IfThenZeroElse(none, hn::IfThenElse(surely, quotient.lo, least(quotient.lo, zero()))),
          hn::IfThenZeroElse(none, hn::IfThenElse(surely, quotient.hi, most(quotient.hi, zero())))};
}

HWY_INLINE Ends select(Ends condition, Ends a, Ends b) {
  const M is_a = lacks_zero(condition), is_b = is_zero(condition);
  const Ends either{least(a.lo, b.lo), most(a.hi, b.hi)};
  const Ends one{hn::IfThenElse(is_a, a.lo, hn::IfThenElse(is_b, b.lo, either.lo)),
                 hn::IfThenElse(is_a, a.hi, hn::IfThenElse(is_b, b.hi, either.hi))};
  return everything_where(is_everything(condition), one);
}

// Marks ops without a vectorised version; they are evaluated one interval at a time.
struct OneByOne {};

// Computes an op on bounded operands. Sums, products, quotients and roots are rounded once, which preserves order.
template <Op op>
HWY_INLINE auto on(Ends a, [[maybe_unused]] Ends b, [[maybe_unused]] Ends c) {
  if constexpr (op == Op::add) {
    return Ends{hn::Add(a.lo, b.lo), hn::Add(a.hi, b.hi)};
  } else if constexpr (op == Op::subtract) {
    return Ends{hn::Sub(a.lo, b.hi), hn::Sub(a.hi, b.lo)};
  } else if constexpr (op == Op::multiply) {
    return around(hn::Mul(a.lo, b.lo), hn::Mul(a.lo, b.hi), hn::Mul(a.hi, b.lo), hn::Mul(a.hi, b.hi));
  } else if constexpr (op == Op::divide) {
    return everything_where(hn::Not(lacks_zero(b)),
                            around(hn::Div(a.lo, b.lo), hn::Div(a.lo, b.hi), hn::Div(a.hi, b.lo), hn::Div(a.hi, b.hi)));
  } else if constexpr (op == Op::negate) {
    return Ends{hn::Neg(a.hi), hn::Neg(a.lo)};
  } else if constexpr (op == Op::min) {
    return Ends{least(a.lo, b.lo), least(a.hi, b.hi)};
  } else if constexpr (op == Op::max) {
    return Ends{most(a.lo, b.lo), most(a.hi, b.hi)};
  } else if constexpr (op == Op::abs) {
    return absolute(a);
  } else if constexpr (op == Op::sqrt) {
    return everything_where(hn::Lt(a.lo, zero()), {hn::Sqrt(most(a.lo, zero())), hn::Sqrt(most(a.hi, zero()))});
  } else if constexpr (op == Op::square) {
    const Ends size = absolute(a);
    return Ends{hn::Mul(size.lo, size.lo), hn::Mul(size.hi, size.hi)};
  } else if constexpr (op == Op::floor) {
    return Ends{batch::floor(a.lo), batch::floor(a.hi)};
  } else if constexpr (op == Op::ceil) {
    return Ends{batch::ceil(a.lo), batch::ceil(a.hi)};
  } else if constexpr (op == Op::round) {
    return Ends{batch::round(a.lo), batch::round(a.hi)};
  } else if constexpr (op == Op::trunc) {
    return Ends{batch::trunc(a.lo), batch::trunc(a.hi)};
  } else if constexpr (op == Op::sin) {
    return wave(a, batch::sin(a.lo), batch::sin(a.hi), std::numbers::pi_v<float> / 2);
  } else if constexpr (op == Op::cos) {
    return wave(a, batch::cos(a.lo), batch::cos(a.hi), 0);
  } else if constexpr (op == Op::atan2) {
    return arc(a, b);
  } else if constexpr (op == Op::exp) {
    return exponential(a);
  } else if constexpr (op == Op::less) {
    return truth_of(hn::Lt(a.hi, b.lo), hn::Ge(a.lo, b.hi));
  } else if constexpr (op == Op::less_equal) {
    return truth_of(hn::Le(a.hi, b.lo), hn::Gt(a.lo, b.hi));
  } else if constexpr (op == Op::equal) {
    const M points = hn::And(hn::Eq(a.lo, a.hi), hn::Eq(b.lo, b.hi));
    return truth_of(hn::And(points, hn::Eq(a.lo, b.lo)), hn::Or(hn::Lt(a.hi, b.lo), hn::Lt(b.hi, a.lo)));
  } else if constexpr (op == Op::truth) {
    return truth_of(lacks_zero(a), is_zero(a));
  } else if constexpr (op == Op::logical_not) {
    return truth_of(is_zero(a), lacks_zero(a));
  } else if constexpr (op == Op::logical_and) {
    return truth_of(hn::And(lacks_zero(a), lacks_zero(b)), hn::Or(is_zero(a), is_zero(b)));
  } else if constexpr (op == Op::logical_or) {
    return truth_of(hn::Or(lacks_zero(a), lacks_zero(b)), hn::And(is_zero(a), is_zero(b)));
  } else if constexpr (op == Op::select) {
    return select(a, b, c);
  } else if constexpr (op == Op::is_finite) {
    return Ends{number(1), number(1)};
  } else if constexpr (op == Op::fma) {
    return fused(a, b, c);
  } else if constexpr (op == Op::share) {
    return share(a, b);
  } else {
    return OneByOne{};
  }
}

template <Op op>
constexpr bool is_one_by_one = std::is_same_v<decltype(on<op>(Ends(), Ends(), Ends())), OneByOne>;

HWY_INLINE Ends load(IntervalRow row, size_t n) { return {hn::Load(D(), row.lo + n), hn::Load(D(), row.hi + n)}; }
inline Interval at(IntervalRow row, size_t n) {
  return {static_cast<double>(row.lo[n]), static_cast<double>(row.hi[n])};
}

// True if the lane equals the one before.
inline bool is_same(IntervalRow row, size_t n) { return row.lo[n] == row.lo[n - 1] && row.hi[n] == row.hi[n - 1]; }

template <Op op, int arity>
void run(IntervalRow a, IntervalRow b, IntervalRow c, IntervalRow out, size_t count) {
  for (size_t n = 0; n < count; n += hn::Lanes(D())) {
    const Ends x = load(a, n);
    M known = is_bounded(x);
    Ends y = x, z = x;
    if constexpr (arity > 1) {
      y = load(b, n);
      known = hn::And(known, is_bounded(y));
    }
    if constexpr (arity > 2) {
      z = load(c, n);
      known = hn::And(known, is_bounded(z));
    }
    const Ends result = on<op>(x, y, z);
    hn::Store(result.lo, D(), out.lo + n);
    hn::Store(result.hi, D(), out.hi + n);
    if (op == Op::select || hn::AllTrue(D(), known)) continue;
    for (size_t i = n; i < n + hn::Lanes(D()); ++i) {
      // Padding repeats the last value.
      const bool is_repeated = i > n && is_same(a, i) && (arity < 2 || is_same(b, i)) && (arity < 3 || is_same(c, i));
      if (is_repeated) {
        out.lo[i] = out.lo[i - 1];
        out.hi[i] = out.hi[i - 1];
        continue;
      }
      const Interval first = at(a, i), second = arity > 1 ? at(b, i) : first, third = arity > 2 ? at(c, i) : first;
      if (first.is_bounded() && second.is_bounded() && third.is_bounded()) continue;
      const Interval value = program::apply_single(op, first, second, third);
      out.lo[i] = static_cast<float>(value.lo);
      out.hi[i] = static_cast<float>(value.hi);
    }
  }
}

inline IntervalKernel kernel(Op op) {
  switch (op) {
#define OMBRE_ROW(name, arity)                                           \
  case Op::name:                                                         \
    if constexpr (is_one_by_one<Op::name>) return nullptr;               \
    if constexpr (!is_one_by_one<Op::name>) return run<Op::name, arity>; \
    break;
    OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
    default:
      break;
  }
  return nullptr;
}

inline Interval hull(IntervalRow row, const float* chosen, size_t count) {
  V lo = number(inf), hi = number(-inf);
  for (size_t n = 0; n < count; n += hn::Lanes(D())) {
    const M is_chosen = batch::is_set(hn::Load(D(), chosen + n));
    const Ends v = load(row, n);
    lo = least(lo, hn::IfThenElse(is_chosen, v.lo, number(inf)));
    hi = most(hi, hn::IfThenElse(is_chosen, v.hi, number(-inf)));
  }
  return {static_cast<double>(hn::GetLane(hn::MinOfLanes(D(), lo))),
          static_cast<double>(hn::GetLane(hn::MaxOfLanes(D(), hi)))};
}

}  // namespace intervals
}  // namespace HWY_NAMESPACE
}  // namespace ombre::eval
HWY_AFTER_NAMESPACE();

#endif
