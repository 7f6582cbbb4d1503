#include "calibration/interpolant.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "base/math/key_place.h"
#include "base/math/math.h"
#include "base/math/monotone_cubic.h"
#include "base/system/assert.h"

namespace ombre::calibration {
namespace {

double weighted(const std::vector<double>& values, std::span<const double> fractions) {
  double sum = values[0];
  for (size_t n = 0; n < fractions.size(); ++n) sum += fractions[n] * (values[n + 1] - values[0]);
  return sum;
}

std::vector<double> logarithms(std::vector<double> values) {
  for (double& value : values) value = math::log(value);
  return values;
}

// Kerner's equation in the form of Halpin, Tsai and Lewis (1970), which gives the value of the inclusions where they
// fill everything.
double kerner(const Constants& c, double share) {
  const double nu = c.poissons_ratio, a = (7 - 5 * nu) / (8 - 10 * nu), ratio = c.values[1] / c.values[0];
  const double b = (ratio - 1) / (ratio + a);
  return c.values[0] * (1 + a * b * share) / (1 - b * share);
}

double percolation(const Constants& c, double share) {
  if (share <= c.threshold) return c.values[0];
  const double above = (share - c.threshold) / (1 - c.threshold);
  return c.values[0] + (c.values[1] - c.values[0]) * math::pow(above, c.exponent);
}

}  // namespace

const std::vector<std::string>& interpolant_names() {
  static const std::vector<std::string> names{"pchip",       "linear", "log-linear",  "mixture",
                                              "log-mixture", "kerner", "percolation", "working-curve"};
  return names;
}

bool has_points(Interpolant interpolant) {
  return interpolant == Interpolant::pchip || interpolant == Interpolant::linear ||
         interpolant == Interpolant::log_linear;
}

Grid::Grid(std::vector<std::vector<double>> axes, std::vector<double> values)
    : axes_(std::move(axes)), values_(std::move(values)) {
  if (axes_.size() == 1) slopes_ = monotone_slopes(axes_[0], values_);
}

double Grid::linear(std::span<const double> at, size_t axis, size_t offset) const {
  if (axis == axes_.size()) return values_[offset];
  const KeyPlace place = place_among(axes_[axis], at[axis]);
  const size_t next = offset * axes_[axis].size() + place.below;
  const double low = linear(at, axis + 1, next);
  if (place.share == 0) return low;
  const double high = linear(at, axis + 1, next + 1);
  return place.share == 1 ? high : low + place.share * (high - low);
}

double Grid::cubic(double at) const {
  if (values_.size() == 1) return values_[0];
  const KeyPlace place = place_among(axes_[0], at);
  return cubic_between(axes_[0], values_, slopes_, place.below, place.share);
}

int Grid::direction(size_t axis) const {
  size_t inner = 1;  // distance of neighbours along the axis
  for (size_t n = axis + 1; n < axes_.size(); ++n) inner *= axes_[n].size();
  const size_t count = axes_[axis].size();
  bool rises = count > 1, falls = count > 1;
  for (size_t n = 0; n < values_.size(); ++n) {
    if (n / inner % count + 1 == count) continue;
    rises = rises && values_[n + inner] > values_[n];
    falls = falls && values_[n + inner] < values_[n];
  }
  return rises ? 1 : falls ? -1 : 0;
}

double law_value(Interpolant law, const Constants& constants, std::span<const double> inputs) {
  ASSERT(!has_points(law));
  switch (law) {
    case Interpolant::mixture:
      return weighted(constants.values, inputs);
    case Interpolant::log_mixture:
      return math::exp(weighted(logarithms(constants.values), inputs));
    case Interpolant::kerner:
      return kerner(constants, inputs[0]);
    case Interpolant::working_curve:
      return constants.penetration * math::log(inputs[0] / constants.critical);
    default:
      return percolation(constants, inputs[0]);
  }
}

}  // namespace ombre::calibration
