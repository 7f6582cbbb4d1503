// Two properties of one mixture of three materials, which determine its fractions together.
#pragma once

#include <array>
#include <optional>

#include "calibration/calibration.h"

namespace ombre::calibration {

// The values of three materials alone, or their logarithms, whose mean by the fractions is the value of a mixture.
struct MixtureLaw {
  std::array<double, 3> values{};  // of the rest, then of each input's material
  bool of_logarithms = false;
};

// Returns the law of a calibration whose inputs are the fractions of two materials, by a rule of mixtures that holds
// for all of them. Returns nothing for other calibrations.
std::optional<MixtureLaw> mixture_law(const Calibration& calibration);

// Fractions in the order of the values. Both laws have the same materials in the same order.
using Fractions = std::array<double, 3>;

// False if one of the properties follows from the other, so that the fractions do not follow from both.
bool determine_fractions(const MixtureLaw& one, const MixtureLaw& two);
// Each fraction is c[0] + c[1] u + c[2] v, where u and v are the properties or their logarithms. They add up to 1, and
// one that is negative means that no mixture has both properties. The laws determine fractions.
std::array<std::array<double, 3>, 3> fractions_of_properties(const MixtureLaw& one, const MixtureLaw& two);
// Returns the values of the first property beside a value of the second one; nothing if no mixture has that.
std::optional<Interval> reach_beside(const MixtureLaw& one, const MixtureLaw& two, double second);

}  // namespace ombre::calibration
