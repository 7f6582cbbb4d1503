#include "base/math/degrees.h"

#include <cmath>
#include <numbers>

#include "base/math/math.h"

namespace ombre::degrees {
namespace {

constexpr double per_radian = 180 / std::numbers::pi;

// Returns the sine of an angle in [0, 90]; at multiples of 30 and 45 it is the nearest number.
double quadrant_sine(double angle) {
  if (angle == 30) return 0.5;
  if (angle == 45) return std::numbers::sqrt2 / 2;
  if (angle == 60) return std::numbers::sqrt3 / 2;
  if (angle == 90) return 1;
  if (angle > 45) return math::cos((90 - angle) / per_radian);
  return math::sin(angle / per_radian);
}

// Rounds an angle to a whole degree if the function of that is exactly the argument.
template <class Function>
double inverse(double angle, double argument, Function function) {
  const double whole = std::round(angle);
  return std::abs(angle - whole) < 1e-9 && function(whole) == argument ? whole : angle;
}

}  // namespace

double sine(double angle) {
  if (!std::isfinite(angle)) return std::nan("");
  double a = std::fmod(std::abs(angle), 360);
  double sign = angle < 0 ? -1 : 1;
  if (a >= 180) {
    a -= 180;
    sign = -sign;
  }
  if (a > 90) a = 180 - a;
  return a == 0 ? 0 : sign * quadrant_sine(a);
}

double cosine(double angle) {
  if (!std::isfinite(angle)) return std::nan("");
  double a = std::fmod(std::abs(angle), 360);
  if (a > 180) a = 360 - a;
  if (a == 90) return 0;
  return a < 90 ? quadrant_sine(90 - a) : -quadrant_sine(a - 90);
}

double tangent(double angle) {
  if (!std::isfinite(angle)) return std::nan("");
  double a = std::fmod(angle, 180);
  if (std::abs(a) > 90) a -= std::copysign(180, a);
  if (std::abs(a) == 30) return std::copysign(std::numbers::sqrt3 / 3, a);
  if (std::abs(a) == 45) return std::copysign(1, a);
  if (std::abs(a) == 60) return std::copysign(std::numbers::sqrt3, a);
  return sine(angle) / cosine(angle);
}

double arc_sine(double x) { return inverse(math::asin(x) * per_radian, x, sine); }
double arc_cosine(double x) { return inverse(math::acos(x) * per_radian, x, cosine); }
double arc_tangent(double x) { return inverse(math::atan(x) * per_radian, x, tangent); }

double arc_tangent2(double y, double x) {
  const double angle = math::atan2(y, x) * per_radian;
  constexpr double rounding = 1e-15;
  const double whole = std::round(angle);
  return std::abs(angle - whole) <= rounding * std::abs(angle) ? whole : angle;
}

}  // namespace ombre::degrees
