// How far numbers lie apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text/data.h"

namespace ombre::compile {

struct Spread {
  double least = 0, mean = 0, greatest = 0;
  double variation = 0;  // standard deviation over mean

  // Each is 0 if there are no values.
  static Spread of(const std::vector<double>& values) {
    if (values.empty()) return {};
    const auto count = static_cast<double>(values.size());
    Spread found{values[0], 0, values[0], 0};
    double squares = 0;
    for (const double value : values) {
      found.least = std::min(found.least, value);
      found.greatest = std::max(found.greatest, value);
      found.mean += value / count;
    }
    for (const double value : values) squares += (value - found.mean) * (value - found.mean);
    if (found.mean > 0) found.variation = std::sqrt(squares / count) / found.mean;
    return found;
  }

  // Returns the numbers as shares of a whole.
  Spread over(double whole) const { return {least / whole, mean / whole, greatest / whole, variation}; }

  DataMembers data() const {
    return {{"least", least}, {"mean", mean}, {"greatest", greatest}, {"variation", variation}};
  }
};

}  // namespace ombre::compile
