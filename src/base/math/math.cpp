#include "base/math/math.h"

#include <sleef.h>

namespace ombre::math {

double sin(double v) { return Sleef_cinz_sind1_u10purec(v); }
double cos(double v) { return Sleef_cinz_cosd1_u10purec(v); }
double tan(double v) { return Sleef_cinz_tand1_u10purec(v); }
double asin(double v) { return Sleef_cinz_asind1_u10purec(v); }
double acos(double v) { return Sleef_cinz_acosd1_u10purec(v); }
double atan(double v) { return Sleef_cinz_atand1_u10purec(v); }
double atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }
double sinh(double v) { return Sleef_cinz_sinhd1_u10purec(v); }
double cosh(double v) { return Sleef_cinz_coshd1_u10purec(v); }
double tanh(double v) { return Sleef_cinz_tanhd1_u10purec(v); }
double exp(double v) { return Sleef_cinz_expd1_u10purec(v); }
double log(double v) { return Sleef_cinz_logd1_u10purec(v); }
double log10(double v) { return Sleef_cinz_log10d1_u10purec(v); }
double log2(double v) { return Sleef_cinz_log2d1_u10purec(v); }
// Computes integer powers of integers by repeated multiplication, which is exact up to 2^53: 10^2 is 100.
double pow(double base, double exponent) {
  constexpr double largest_exact = 0x1p53;
  if (base == std::trunc(base) && exponent == std::trunc(exponent) && std::abs(exponent) <= 53) {
    double product = 1;
    for (int left = std::abs(static_cast<int>(exponent)); left > 0; --left) product *= base;
    if (std::abs(product) <= largest_exact) return exponent < 0 ? 1 / product : product;
  }
  return Sleef_cinz_powd1_u10purec(base, exponent);
}

}  // namespace ombre::math
