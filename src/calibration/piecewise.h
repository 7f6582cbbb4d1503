// Calibrations of one input as piecewise linear curves, which programs evaluate as tables.
#pragma once

#include <utility>
#include <vector>

#include "calibration/calibration.h"

namespace ombre::calibration {

// Pairs of numbers, ascending in the first, with lines between them.
struct Piecewise {
  bool of_logarithm = false;  // the first numbers are logarithms of what the curve is a function of
  std::vector<std::pair<double, double>> points;
};

// Returns the ends of some choices of an input, and the numbers of the calibration's points between them, ascending.
std::vector<double> corners_of(const Calibration& calibration, size_t input, const Interval& choices);

// Error of the curves, as a share of the range of what they give.
inline constexpr double piecewise_tolerance = 2e-7;

// Returns the input that gives a value, as a function of the value or its logarithm, over all that is reached. The
// others have their values in `at`; is_invertible(input).
Piecewise inverse_curve(const Calibration& calibration, size_t input, std::span<const double> at);
// Returns the value as a function of the input, over the input's choices.
Piecewise forward_curve(const Calibration& calibration, size_t input, std::span<const double> at);

}  // namespace ombre::calibration
