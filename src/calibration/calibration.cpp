// Computes with calibrations.
#include "calibration/calibration.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/math/math.h"
#include "base/system/assert.h"

namespace ombre::calibration {

std::string Input::text() const { return is_fraction() ? "the fraction of " + materials.front() : attribute; }

bool Calibration::concerns(std::string_view attribute) const {
  return property == attribute || input_called(attribute) < inputs.size() || (inks && attribute == colour_with_alpha);
}

double Calibration::value(std::span<const double> at) const {
  ASSERT(at.size() == inputs.size());
  std::vector<double> valid(at.begin(), at.end());
  for (size_t n = 0; n < valid.size(); ++n)
    valid[n] = math::min(math::max(valid[n], inputs[n].valid->lo), inputs[n].valid->hi);
  switch (interpolant) {
    case Interpolant::pchip:
      return grid.cubic(valid[0]);
    case Interpolant::linear:
      return grid.linear(valid);
    case Interpolant::log_linear:
      return math::exp(grid.linear(valid));
    default:
      return law_value(interpolant, constants, valid);
  }
}

std::optional<double> Calibration::spread(std::span<const double> at) const {
  if (sd) return *sd;
  if (relative_sd) return *relative_sd * std::abs(value(at));
  if (spreads.values().empty()) return std::nullopt;
  return spreads.linear(at);
}

Interval Calibration::choices(size_t input, std::span<const double> at) const {
  Interval choices = *inputs[input].valid;
  if (interpolant == Interpolant::percolation) choices.lo = std::max(choices.lo, constants.threshold);
  if (!inputs[input].is_fraction()) return choices;
  double left = 1;
  for (size_t n = 0; n < inputs.size(); ++n)
    if (n != input && inputs[n].is_fraction()) left -= at[n];
  choices.hi = std::min(choices.hi, left);
  return choices;
}

bool Calibration::is_invertible(size_t input) const {
  if (has_points(interpolant)) return grid.direction(input) != 0;
  if (interpolant == Interpolant::working_curve) return true;
  return constants.values[0] != constants.values[input + 1];
}

Interval Calibration::reach(size_t input, std::span<const double> at) const {
  const Interval ends = choices(input, at);
  std::vector<double> inputs_at(at.begin(), at.end());
  inputs_at[input] = ends.lo;
  const double first = value(inputs_at);
  inputs_at[input] = ends.hi;
  const double last = value(inputs_at);
  return {std::min(first, last), std::max(first, last)};
}

Interval Calibration::reach_of_mixtures() const {
  const auto [least, most] = std::ranges::minmax(constants.values);
  return {least, most};
}

Interval Calibration::whole_reach(size_t input) const {
  // The values between the points of a grid lie between those of the points.
  std::vector<size_t> others;
  for (size_t n = 0; n < inputs.size(); ++n)
    if (n != input && !inputs[n].usual) others.push_back(n);
  std::vector<double> at = usual();
  if (others.empty() || !has_points(interpolant)) return reach(input, at);
  Interval all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const std::function<void(size_t)> visit = [&](size_t n) {
    if (n == others.size()) {
      const Interval here = reach(input, at);
      all = {std::min(all.lo, here.lo), std::max(all.hi, here.hi)};
      return;
    }
    const Interval& valid = *inputs[others[n]].valid;
    for (const double key : grid.axes()[others[n]]) {
      at[others[n]] = math::min(math::max(key, valid.lo), valid.hi);
      visit(n + 1);
    }
  };
  visit(0);
  return all;
}

Inverse Calibration::inverse(size_t input, double wanted, std::span<const double> at) const {
  ASSERT(is_invertible(input));
  std::vector<double> inputs_at(at.begin(), at.end());
  const auto value_at = [&](double choice) {
    inputs_at[input] = choice;
    return value(inputs_at);
  };
  const Interval ends = choices(input, at);
  double lo = ends.lo, hi = ends.hi, at_lo = value_at(lo), at_hi = value_at(hi);
  const bool rises = at_hi > at_lo;
  // A value that is not reached has the nearer end as its answer.
  const auto is_before = [&](double value) { return rises ? value < wanted : value > wanted; };
  if (std::isnan(wanted) || !is_before(at_lo)) return {lo, at_lo, wanted == at_lo};
  if (is_before(at_hi)) return {hi, at_hi, false};
  // Bisection, until the ends are neighbouring doubles.
  for (double middle = lo + (hi - lo) / 2; middle > lo && middle < hi; middle = lo + (hi - lo) / 2) {
    const double at_middle = value_at(middle);
    (is_before(at_middle) ? lo : hi) = middle;
    (is_before(at_middle) ? at_lo : at_hi) = at_middle;
  }
  const bool take_lo = std::abs(wanted - at_lo) < std::abs(wanted - at_hi);
  return {take_lo ? lo : hi, wanted, true};
}

size_t Calibration::input_called(std::string_view attribute) const {
  return static_cast<size_t>(std::ranges::find(inputs, attribute, &Input::attribute) - inputs.begin());
}

std::vector<double> Calibration::usual() const {
  std::vector<double> values;
  for (const Input& input : inputs) values.push_back(input.usual.value_or(0));
  return values;
}

}  // namespace ombre::calibration
