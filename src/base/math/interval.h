// Closed intervals that enclose every rounded result: the lower end is rounded down, the upper end up.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace ombre {

struct Interval {
  double lo = 0, hi = 0;

  Interval() = default;
  Interval(double value) : lo(value), hi(value) {}  // NOLINT: a number is an interval
  Interval(double low, double high) : lo(low), hi(high) {}

  // The interval of a value about which nothing is known. The value may also be NaN.
  static Interval everything() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return {-inf, inf};
  }
  bool is_everything() const { return std::isinf(lo) && std::isinf(hi) && lo < 0 && hi > 0; }
  bool is_bounded() const { return std::isfinite(lo) && std::isfinite(hi); }
  bool is_point() const { return lo == hi; }
  bool contains(double v) const { return (lo <= v && v <= hi) || (std::isnan(v) && is_everything()); }
  bool operator==(const Interval&) const = default;
};

inline bool is_zero(Interval v) { return v.lo == 0 && v.hi == 0; }
inline bool lacks_zero(Interval v) { return v.lo > 0 || v.hi < 0; }
inline Interval hull(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
inline double round_down(double v) { return std::nextafter(v, -std::numeric_limits<double>::infinity()); }
inline double round_up(double v) { return std::nextafter(v, std::numeric_limits<double>::infinity()); }
// Widens the interval by one unit in the last place on both sides. If an end is NaN, returns everything().
inline Interval outward(double lo, double hi) {
  if (std::isnan(lo) || std::isnan(hi)) return Interval::everything();
  return {round_down(lo), round_up(hi)};
}

}  // namespace ombre
