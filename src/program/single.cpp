#include "program/single.h"

#include <iterator>

#include "program/quick_intervals.h"

namespace ombre::program {
namespace {

// Widens by two floats on each side: elementary functions of batches are accurate to one unit in the last place.
Interval widened(Interval v) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const auto down = [](float end) { return std::nextafter(std::nextafter(end, -inf), -inf); };
  const auto up = [](float end) { return std::nextafter(std::nextafter(end, inf), inf); };
  return {static_cast<double>(down(static_cast<float>(v.lo))), static_cast<double>(up(static_cast<float>(v.hi)))};
}

Interval trigonometric(Interval argument, Interval value) {
  if (argument.lo < -batch_trigonometric_limit || argument.hi > batch_trigonometric_limit)
    return Interval::everything();
  return to_single(
      {std::max(-1.0, value.lo - batch_trigonometric_error), std::min(1.0, value.hi + batch_trigonometric_error)});
}

double fused_single(double a, double b, double c) {
  return static_cast<double>(std::fma(static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)));
}

// A fused multiply-add is rounded once, which preserves order. Its extremes are at the extreme products, which are
// exact in doubles.
Interval fused(Interval a, Interval b, Interval c) {
  if (math::multiply(a, b).is_everything()) return Interval::everything();
  double products[] = {a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  const auto [least, most] = std::minmax_element(std::begin(products), std::end(products));
  const auto at = [&](const double* product, double z) {
    const auto corner = product - products;
    return fused_single(corner < 2 ? a.lo : a.hi, corner % 2 == 0 ? b.lo : b.hi, z);
  };
  const double lo = at(least, c.lo), hi = at(most, c.hi);
  return std::isnan(lo) || std::isnan(hi) ? Interval::everything() : Interval(lo, hi);
}

Interval select(Interval condition, Interval a, Interval b) {
  if (lacks_zero(condition)) return a;
  if (is_zero(condition)) return b;
  return condition.is_everything() ? condition : hull(a, b);
}

Interval logical(Op op, Interval a, Interval b) {
  const bool settled = op == Op::logical_and ? is_zero(a) || is_zero(b) : lacks_zero(a) || lacks_zero(b);
  if (settled) return op == Op::logical_and ? 0 : 1;
  if (a.is_everything() || b.is_everything()) return Interval::everything();
  return op == Op::logical_and ? math::logical_and(a, b) : math::logical_or(a, b);
}

// The remainder is exact: rounded operands give a remainder in another period only if the interval already contains it.
Interval elementary(Op op, Interval a, Interval b, Interval c) {
  const Interval value = apply(op, a, b, c);
  if (value.is_everything()) return value;
  const bool not_negative = value.lo >= 0;
  Interval wide = widened(value);
  // Functions of floats overflow a little below the largest float.
  constexpr double inf = std::numeric_limits<double>::infinity(), near_the_end = 0x1p126;
  if (wide.hi > near_the_end) wide.hi = inf;
  if (wide.lo < -near_the_end) wide.lo = -inf;
  return {not_negative ? std::max(0.0, wide.lo) : wide.lo, wide.hi};
}

}  // namespace

Interval to_single(Interval v) {
  return {static_cast<double>(static_cast<float>(v.lo)), static_cast<double>(static_cast<float>(v.hi))};
}

Interval apply_single(Op op, Interval a, Interval b, Interval c) {
  if (op == Op::select) return select(a, b, c);
  if (op == Op::logical_and || op == Op::logical_or) return logical(op, a, b);
  const auto single = [](double v) { return static_cast<double>(static_cast<float>(v)); };
  if (const Interval quick = quick_interval(op, a, b, single); !std::isnan(quick.lo)) return quick;
  const int arity = info(op).arity;
  if (a.is_everything() || (arity > 1 && b.is_everything()) || (arity > 2 && c.is_everything()))
    return Interval::everything();
  switch (op) {
    case Op::fma:
      return fused(a, b, c);
    case Op::sin:
    case Op::cos:
      return trigonometric(a, apply(op, a, b, c));
    case Op::tan:
    case Op::asin:
    case Op::acos:
    case Op::atan:
    case Op::atan2:
    case Op::sinh:
    case Op::cosh:
    case Op::tanh:
    case Op::exp:
    case Op::log:
    case Op::log10:
    case Op::log2:
    case Op::pow:
      return elementary(op, a, b, c);
    case Op::is_finite:
      return a.is_bounded() ? Interval(1) : Interval::everything();
    default:
      return to_single(apply(op, a, b, c));
  }
}

}  // namespace ombre::program
