#include "calibration/joint.h"

#include <algorithm>
#include <cmath>

#include "base/math/math.h"
#include "base/system/assert.h"

namespace ombre::calibration {
namespace {

// The least part of the largest product in a determinant that is taken for more than rounding.
constexpr double least_determinant = 1e-9;

// Differences of the values from that of the rest.
struct Slopes {
  double first, second;
  explicit Slopes(const MixtureLaw& law)
      : first(law.values[1] - law.values[0]), second(law.values[2] - law.values[0]) {}
};

double determinant(const Slopes& one, const Slopes& two) { return one.first * two.second - one.second * two.first; }

double linear(const MixtureLaw& law, double value) { return law.of_logarithms ? math::log(value) : value; }
double value_of(const MixtureLaw& law, double linear) { return law.of_logarithms ? math::exp(linear) : linear; }

}  // namespace

std::optional<MixtureLaw> mixture_law(const Calibration& calibration) {
  const bool of_logarithms = calibration.interpolant == Interpolant::log_mixture;
  if (!of_logarithms && calibration.interpolant != Interpolant::mixture) return std::nullopt;
  if (calibration.inks || calibration.inputs.size() != 2) return std::nullopt;
  const auto is_free = [](const Input& input) {
    return input.is_fraction() && input.valid->lo <= 0 && input.valid->hi >= 1;
  };
  if (!std::ranges::all_of(calibration.inputs, is_free)) return std::nullopt;
  MixtureLaw law;
  law.of_logarithms = of_logarithms;
  for (size_t n = 0; n < law.values.size(); ++n) {
    const double value = calibration.constants.values[n];
    law.values[n] = of_logarithms ? math::log(value) : value;
  }
  return law;
}

bool determine_fractions(const MixtureLaw& one, const MixtureLaw& two) {
  const Slopes a(one), b(two);
  const double largest = std::max(std::abs(a.first * b.second), std::abs(a.second * b.first));
  return std::abs(determinant(a, b)) > least_determinant * largest;
}

std::array<std::array<double, 3>, 3> fractions_of_properties(const MixtureLaw& one, const MixtureLaw& two) {
  ASSERT(determine_fractions(one, two));
  const Slopes a(one), b(two);
  const double scale = 1 / determinant(a, b), u0 = one.values[0], v0 = two.values[0];
  // Cramer's rule.
  const std::array<double, 3> first{scale * (a.second * v0 - b.second * u0), scale * b.second, -scale * a.second};
  const std::array<double, 3> second{scale * (b.first * u0 - a.first * v0), -scale * b.first, scale * a.first};
  return {{{1 - first[0] - second[0], -first[1] - second[1], -first[2] - second[2]}, first, second}};
}

std::optional<Interval> reach_beside(const MixtureLaw& one, const MixtureLaw& two, double second) {
  const double v = linear(two, second);
  std::optional<Interval> reach;
  const auto add = [&](double u) {
    const Interval here(value_of(one, u));
    reach = reach ? hull(*reach, here) : here;
  };
  // The mixtures with this value are a line through the triangle of all mixtures, which ends at two of its sides.
  for (size_t n = 0; n < 3; ++n) {
    const size_t next = (n + 1) % 3;
    const double from = two.values[n], to = two.values[next];
    if (v < std::min(from, to) || v > std::max(from, to)) continue;
    if (from == to) {
      add(one.values[n]);
      add(one.values[next]);
    } else {
      add(one.values[n] + (v - from) / (to - from) * (one.values[next] - one.values[n]));
    }
  }
  return reach;
}

}  // namespace ombre::calibration
