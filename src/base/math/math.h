// Elementary functions with bit-identical results on every machine, and their interval versions.
//
// libm selects its code by processor, so its last bit differs between machines. These functions call SLEEF's
// deterministic ("cinz") scalar family, whose error is at most one unit in the last place.
#pragma once

#include <numbers>

#include "base/math/interval.h"

namespace ombre::math {

inline constexpr double degree = std::numbers::pi / 180;  // one degree in radians

double sin(double v);
double cos(double v);
double tan(double v);
double asin(double v);
double acos(double v);
double atan(double v);
double atan2(double y, double x);
double sinh(double v);
double cosh(double v);
double tanh(double v);
double exp(double v);
double log(double v);
double log10(double v);
double log2(double v);
double pow(double base, double exponent);

inline double abs(double v) { return std::fabs(v); }
inline double sqrt(double v) { return std::sqrt(v); }  // IEEE 754 requires correct rounding
inline double floor(double v) { return std::floor(v); }
inline double ceil(double v) { return std::ceil(v); }
inline double trunc(double v) { return std::trunc(v); }
inline double round(double v) { return std::round(v); }  // halves are rounded away from zero
inline double mod(double a, double b) { return std::fmod(a, b); }
inline double square(double v) { return v * v; }
// If one operand is NaN, min and max return the other one.
inline double min(double a, double b) { return std::isnan(a) || b < a ? b : a; }
inline double max(double a, double b) { return std::isnan(a) || b > a ? b : a; }
// Truth values are 1 and 0. Comparisons with NaN are false.
inline double less(double a, double b) { return a < b ? 1 : 0; }
inline double less_equal(double a, double b) { return a <= b ? 1 : 0; }
inline double equal(double a, double b) { return a == b ? 1 : 0; }
inline double truth(double v) { return v != 0 ? 1 : 0; }
inline double logical_not(double v) { return v != 0 ? 0 : 1; }
inline double logical_and(double a, double b) { return a != 0 && b != 0 ? 1 : 0; }
inline double logical_or(double a, double b) { return a != 0 || b != 0 ? 1 : 0; }
inline double fma(double a, double b, double c) { return std::fma(a, b, c); }  // a single rounding
// Returns part / total, at most 1. Returns 0 if the total is 0, so that 0 / 0 does not give NaN.
inline double share(double part, double total) { return !(total > 0) ? 0 : part / total > 1 ? 1 : part / total; }
inline double select(double condition, double a, double b) { return condition != 0 ? a : b; }
inline double is_finite(double v) { return std::isfinite(v) ? 1 : 0; }

// Interval versions. Each result contains every rounded value that the double version can return for operands in the
// intervals. If that value may be NaN, the result is everything().
Interval add(Interval a, Interval b);
Interval subtract(Interval a, Interval b);
Interval multiply(Interval a, Interval b);
Interval divide(Interval a, Interval b);
Interval negate(Interval v);
Interval sin(Interval v);
Interval cos(Interval v);
Interval tan(Interval v);
Interval asin(Interval v);
Interval acos(Interval v);
Interval atan(Interval v);
Interval atan2(Interval y, Interval x);
Interval sinh(Interval v);
Interval cosh(Interval v);
Interval tanh(Interval v);
Interval exp(Interval v);
Interval log(Interval v);
Interval log10(Interval v);
Interval log2(Interval v);
Interval pow(Interval base, Interval exponent);
Interval abs(Interval v);
Interval sqrt(Interval v);
Interval floor(Interval v);
Interval ceil(Interval v);
Interval trunc(Interval v);
Interval round(Interval v);
Interval mod(Interval a, Interval b);
Interval square(Interval v);
Interval min(Interval a, Interval b);
Interval max(Interval a, Interval b);
Interval less(Interval a, Interval b);
Interval less_equal(Interval a, Interval b);
Interval equal(Interval a, Interval b);
Interval truth(Interval v);
Interval logical_not(Interval v);
Interval logical_and(Interval a, Interval b);
Interval logical_or(Interval a, Interval b);
Interval fma(Interval a, Interval b, Interval c);
Interval share(Interval part, Interval total);
Interval select(Interval condition, Interval a, Interval b);
Interval is_finite(Interval v);

inline double add(double a, double b) { return a + b; }
inline double subtract(double a, double b) { return a - b; }
inline double multiply(double a, double b) { return a * b; }
inline double divide(double a, double b) { return a / b; }
inline double negate(double v) { return -v; }

}  // namespace ombre::math
