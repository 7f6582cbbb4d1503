// Round numbers for axes and scales: 1, 2 and 5 times powers of ten.
#pragma once

#include <initializer_list>

namespace ombre::math {

// Returns the greatest round number that is not above `most`, which is positive; 1e-9 of it do not count.
inline double greatest_round(double most) {
  constexpr double slack = 1 + 1e-9;
  double power = 1;
  while (power > most * slack) power /= 10;
  while (power * 10 <= most * slack) power *= 10;
  for (const double times : {5.0, 2.0})
    if (times * power <= most * slack) return times * power;
  return power;
}

// Returns the least round number that is not below `least`, which is positive; 1e-9 of it do not count.
inline double least_round(double least) {
  const double below = greatest_round(least);
  return below * (1 + 1e-9) >= least ? below : greatest_round(2.5 * below);
}

}  // namespace ombre::math
