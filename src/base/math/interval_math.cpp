// Interval versions of the elementary functions.
//
// Sums, products, quotients and roots are correctly rounded, and rounding preserves order: results at the ends of the
// intervals enclose all others without widening. A function with an error of one unit in the last place that is
// monotonic on an interval is enclosed by its values at the ends, widened by two units.
#include <iterator>
#include <numbers>

#include "base/math/math.h"

namespace ombre::math {
namespace {

constexpr double pi = std::numbers::pi;

Interval widen(double lo, double hi) {
  const Interval once = outward(lo, hi);
  return outward(once.lo, once.hi);
}

// Returns everything() if an end is NaN, as it is when infinities cancel.
Interval ordered(double lo, double hi) {
  return std::isnan(lo) || std::isnan(hi) ? Interval::everything() : Interval(lo, hi);
}

Interval clip(Interval v, double lo, double hi) { return {std::max(v.lo, lo), std::min(v.hi, hi)}; }

template <class F>
Interval increasing(Interval v, F f) {
  return v.is_everything() ? v : widen(f(v.lo), f(v.hi));
}

// True if v may contain phase + 2 pi n for an integer n; the tolerance errs towards true.
bool meets(Interval v, double phase) {
  const double slack = 1e-9 * (1 + std::max(std::abs(v.lo), std::abs(v.hi)));
  const double n = std::ceil((v.lo - slack - phase) / (2 * pi));
  return phase + 2 * pi * n <= v.hi + slack;
}

// Returns 1 if surely true, 0 if never true, else [0, 1].
Interval truth_of(bool surely, bool never) { return surely ? Interval(1) : never ? Interval(0) : Interval(0, 1); }

}  // namespace

Interval add(Interval a, Interval b) { return ordered(a.lo + b.lo, a.hi + b.hi); }
Interval subtract(Interval a, Interval b) { return ordered(a.lo - b.hi, a.hi - b.lo); }
Interval negate(Interval v) { return {-v.hi, -v.lo}; }

Interval multiply(Interval a, Interval b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  if (std::isnan(p) || std::isnan(q) || std::isnan(r) || std::isnan(s)) return Interval::everything();
  // An unbounded factor times a zero inside the other factor is NaN.
  if (!a.is_bounded() && !lacks_zero(b)) return Interval::everything();
  if (!b.is_bounded() && !lacks_zero(a)) return Interval::everything();
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}

// A fused multiply-add is rounded once, which preserves order, so the extremes are at corners.
Interval fma(Interval a, Interval b, Interval c) {
  if (multiply(a, b).is_everything()) return Interval::everything();
  const double corners[] = {std::fma(a.lo, b.lo, c.lo), std::fma(a.lo, b.hi, c.lo), std::fma(a.hi, b.lo, c.lo),
                            std::fma(a.hi, b.hi, c.lo), std::fma(a.lo, b.lo, c.hi), std::fma(a.lo, b.hi, c.hi),
                            std::fma(a.hi, b.lo, c.hi), std::fma(a.hi, b.hi, c.hi)};
  if (std::any_of(std::begin(corners), std::end(corners), [](double v) { return std::isnan(v); }))
    return Interval::everything();
  const auto [lo, hi] = std::minmax_element(std::begin(corners), std::end(corners));
  return {*lo, *hi};
}

Interval divide(Interval a, Interval b) {
  if (!lacks_zero(b) || !a.is_bounded() || !b.is_bounded()) return Interval::everything();
  const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}

Interval share(Interval part, Interval total) {
  const bool may_be_nan = part.is_everything() || total.is_everything() || (!part.is_bounded() && !total.is_bounded());
  if (may_be_nan) return Interval::everything();
  if (total.hi <= 0) return 0;
  constexpr double inf = std::numeric_limits<double>::infinity();
  const bool surely = total.lo > 0;
  const double lo = part.lo >= 0 ? part.lo / total.hi : surely ? part.lo / total.lo : -inf;
  const double hi = part.hi <= 0 ? part.hi / total.hi : surely ? part.hi / total.lo : inf;
  const Interval quotient{std::min(lo, 1.0), std::min(hi, 1.0)};
  return surely ? quotient : hull(quotient, 0);
}

Interval sin(Interval v) {
  if (!v.is_bounded() || v.hi - v.lo >= 2 * pi || std::max(std::abs(v.lo), std::abs(v.hi)) > 1e8)
    return v.is_bounded() ? Interval(-1, 1) : Interval::everything();
  Interval r = widen(std::min(sin(v.lo), sin(v.hi)), std::max(sin(v.lo), sin(v.hi)));
  if (meets(v, pi / 2)) r.hi = 1;
  if (meets(v, -pi / 2)) r.lo = -1;
  return clip(r, -1, 1);
}

Interval cos(Interval v) {
  if (!v.is_bounded() || v.hi - v.lo >= 2 * pi || std::max(std::abs(v.lo), std::abs(v.hi)) > 1e8)
    return v.is_bounded() ? Interval(-1, 1) : Interval::everything();
  Interval r = widen(std::min(cos(v.lo), cos(v.hi)), std::max(cos(v.lo), cos(v.hi)));
  if (meets(v, 0)) r.hi = 1;
  if (meets(v, pi)) r.lo = -1;
  return clip(r, -1, 1);
}

Interval tan(Interval v) {
  if (!v.is_bounded() || v.hi - v.lo >= pi || std::max(std::abs(v.lo), std::abs(v.hi)) > 1e8)
    return Interval::everything();
  if (meets(v, pi / 2) || meets(v, -pi / 2)) return Interval::everything();
  return increasing(v, [](double t) { return tan(t); });
}

Interval asin(Interval v) {
  if (v.lo < -1 || v.hi > 1) return Interval::everything();
  return increasing(v, [](double t) { return asin(t); });
}

Interval acos(Interval v) {
  if (v.lo < -1 || v.hi > 1) return Interval::everything();
  return widen(acos(v.hi), acos(v.lo));
}

Interval atan(Interval v) {
  return increasing(v, [](double t) { return atan(t); });
}

Interval atan2(Interval y, Interval x) {
  if (!y.is_bounded() || !x.is_bounded()) return Interval::everything();
  const bool crosses_cut = x.lo <= 0 && y.lo <= 0 && y.hi >= 0;
  if (crosses_cut) return {-round_up(pi), round_up(pi)};
  // Away from the branch cut and the origin the extremes are at corners.
  const double a = atan2(y.lo, x.lo), b = atan2(y.lo, x.hi), c = atan2(y.hi, x.lo), d = atan2(y.hi, x.hi);
  return widen(std::min({a, b, c, d}), std::max({a, b, c, d}));
}

Interval sinh(Interval v) {
  return increasing(v, [](double t) { return sinh(t); });
}
Interval tanh(Interval v) {
  return increasing(v, [](double t) { return tanh(t); });
}
Interval exp(Interval v) {
  if (v.is_everything()) return v;
  const Interval r = widen(exp(v.lo), exp(v.hi));
  return {std::max(0.0, r.lo), r.hi};
}

Interval cosh(Interval v) {
  if (v.is_everything()) return v;
  const Interval a = abs(v);
  const Interval r = widen(cosh(a.lo), cosh(a.hi));
  return {std::max(1.0, r.lo), r.hi};
}

Interval log(Interval v) {
  return v.lo < 0 ? Interval::everything() : increasing(v, [](double t) { return log(t); });
}
Interval log10(Interval v) {
  return v.lo < 0 ? Interval::everything() : increasing(v, [](double t) { return log10(t); });
}
Interval log2(Interval v) {
  return v.lo < 0 ? Interval::everything() : increasing(v, [](double t) { return log2(t); });
}

Interval pow(Interval base, Interval exponent) {
  if (base.lo < 0 || !base.is_bounded() || !exponent.is_bounded()) return Interval::everything();
  if (base.lo == 0 && exponent.lo <= 0) return Interval::everything();
  // For a non-negative base the function is monotonic in each operand, so the extremes are at corners.
  const double a = pow(base.lo, exponent.lo), b = pow(base.lo, exponent.hi);
  const double c = pow(base.hi, exponent.lo), d = pow(base.hi, exponent.hi);
  const Interval r = widen(std::min({a, b, c, d}), std::max({a, b, c, d}));
  return {std::max(0.0, r.lo), r.hi};
}

Interval abs(Interval v) {
  if (v.is_everything()) return v;
  if (v.lo >= 0) return v;
  if (v.hi <= 0) return {-v.hi, -v.lo};
  return {0, std::max(-v.lo, v.hi)};
}

Interval sqrt(Interval v) {
  if (v.lo < 0) return Interval::everything();
  return {std::sqrt(v.lo), std::sqrt(v.hi)};  // correct rounding keeps the root monotonic
}

Interval floor(Interval v) { return {std::floor(v.lo), std::floor(v.hi)}; }
Interval ceil(Interval v) { return {std::ceil(v.lo), std::ceil(v.hi)}; }
Interval trunc(Interval v) { return {std::trunc(v.lo), std::trunc(v.hi)}; }
Interval round(Interval v) { return {std::round(v.lo), std::round(v.hi)}; }

Interval mod(Interval a, Interval b) {
  if (!a.is_bounded() || !b.is_bounded() || !lacks_zero(b)) return Interval::everything();
  // The remainder grows with the dividend if there is a single divisor and the quotient does not change.
  if (b.is_point() && std::trunc(a.lo / b.lo) == std::trunc(a.hi / b.lo) && (a.lo >= 0 || a.hi <= 0)) {
    const double lo = std::fmod(a.lo, b.lo), hi = std::fmod(a.hi, b.lo);
    if (lo <= hi) return {lo, hi};
  }
  const double m = std::max(std::abs(b.lo), std::abs(b.hi));
  return {a.lo < 0 ? -m : 0, a.hi > 0 ? m : 0};
}

Interval square(Interval v) {
  if (v.is_everything()) return v;
  const Interval a = abs(v);
  return {a.lo * a.lo, a.hi * a.hi};
}

Interval min(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
Interval max(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }

// A value that may be NaN has the interval everything(), so comparisons with it are never certain.
Interval less(Interval a, Interval b) {
  return truth_of(a.hi < b.lo, !a.is_everything() && !b.is_everything() && a.lo >= b.hi);
}
Interval less_equal(Interval a, Interval b) {
  if (a.is_everything() || b.is_everything()) return {0, 1};
  return truth_of(a.hi <= b.lo, a.lo > b.hi);
}
Interval equal(Interval a, Interval b) {
  if (a.is_everything() || b.is_everything()) return {0, 1};
  return truth_of(a.is_point() && b.is_point() && a.lo == b.lo, a.hi < b.lo || b.hi < a.lo);
}
Interval truth(Interval v) { return truth_of(lacks_zero(v), is_zero(v)); }
Interval logical_not(Interval v) { return truth_of(is_zero(v), lacks_zero(v)); }
Interval logical_and(Interval a, Interval b) {
  return truth_of(lacks_zero(a) && lacks_zero(b), is_zero(a) || is_zero(b));
}
Interval logical_or(Interval a, Interval b) {
  return truth_of(lacks_zero(a) || lacks_zero(b), is_zero(a) && is_zero(b));
}
Interval select(Interval condition, Interval a, Interval b) {
  if (lacks_zero(condition)) return a;
  if (is_zero(condition)) return b;
  return hull(a, b);
}
Interval is_finite(Interval v) { return v.is_bounded() ? Interval(1) : Interval(0, 1); }

}  // namespace ombre::math
