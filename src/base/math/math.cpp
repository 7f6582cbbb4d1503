#include "base/math/math.h"

#include <sleef.h>

#include "base/math/elementary_functions.h"

namespace ombre::math {

#define OMBRE_FUNCTION(name) \
  double name(double v) { return Sleef_cinz_##name##d1_u10purec(v); }
OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_FUNCTION)
#undef OMBRE_FUNCTION

double atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }

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
