#include "nodes/common/linear_filter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/math/math.h"
#include "design/stage.h"

namespace ombre::nodes {
namespace {

using design::Kernel;

double weight_at(const Kernel& kernel, size_t i, size_t j, size_t k) {
  const auto ny = static_cast<size_t>(kernel.size[1]), nz = static_cast<size_t>(kernel.size[2]);
  return kernel.weights[(i * ny + j) * nz + k];
}

double sum_of(std::span<const double> weights) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  return sum;
}

void divide(std::vector<double>& weights, double by) {
  for (double& weight : weights) weight /= by;
}

using Factors = std::array<std::vector<double>, 3>;

// Returns lists along the axes whose product is the kernel, or nothing if there are none.
std::optional<Factors> factors_of(const Kernel& kernel) {
  const auto n = [&](size_t axis) { return static_cast<size_t>(kernel.size[axis]); };
  const auto greatest = std::ranges::max_element(kernel.weights, {}, [](double w) { return std::abs(w); });
  const auto place = static_cast<size_t>(greatest - kernel.weights.begin());
  const size_t pk = place % n(2), pj = place / n(2) % n(1), pi = place / n(2) / n(1);
  Factors factors;
  for (size_t i = 0; i < n(0); ++i) factors[0].push_back(weight_at(kernel, i, pj, pk));
  for (size_t j = 0; j < n(1); ++j) factors[1].push_back(weight_at(kernel, pi, j, pk) / *greatest);
  for (size_t k = 0; k < n(2); ++k) factors[2].push_back(weight_at(kernel, pi, pj, k) / *greatest);
  const double rounding = 1e-14 * std::abs(*greatest);
  for (size_t i = 0; i < n(0); ++i)
    for (size_t j = 0; j < n(1); ++j)
      for (size_t k = 0; k < n(2); ++k) {
        const double product = factors[0][i] * factors[1][j] * factors[2][k];
        if (!(std::abs(product - weight_at(kernel, i, j, k)) <= rounding)) return std::nullopt;
      }
  return factors;
}

std::vector<double> gaussian_weights(double sigma) {
  constexpr double reach = 4;  // number of sigmas at which weights end
  const auto radius = static_cast<int>(std::floor(reach * sigma + 0.5));
  std::vector<double> weights;
  for (int n = -radius; n <= radius; ++n) weights.push_back(math::exp(-0.5 * n * n / (sigma * sigma)));
  divide(weights, sum_of(weights));
  return weights;
}

}  // namespace

LinearFilter::Pass LinearFilter::along(size_t axis, std::vector<double> weights) {
  Pass pass;
  pass.size[axis] = static_cast<int64_t>(weights.size());
  pass.weights = std::move(weights);
  return pass;
}

LinearFilter LinearFilter::of(const Kernel& kernel) {
  Kernel scaled = kernel;
  const double sum = sum_of(scaled.weights);
  if (sum != 0) divide(scaled.weights, sum);
  LinearFilter filter;
  if (const auto factors = factors_of(scaled)) {
    for (size_t axis = 0; axis < 3; ++axis) filter.passes_.push_back(along(axis, (*factors)[axis]));
    return filter;
  }
  Pass pass{{kernel.size[0], kernel.size[1], kernel.size[2]}, {}};
  for (size_t k = 0; k < static_cast<size_t>(kernel.size[2]); ++k)
    for (size_t j = 0; j < static_cast<size_t>(kernel.size[1]); ++j)
      for (size_t i = 0; i < static_cast<size_t>(kernel.size[0]); ++i)
        pass.weights.push_back(weight_at(scaled, i, j, k));
  filter.passes_.push_back(std::move(pass));
  return filter;
}

LinearFilter LinearFilter::gaussian(Vec3 sigma) {
  LinearFilter filter;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double s = sigma[static_cast<int>(axis)];
    if (s > 0) filter.passes_.push_back(along(axis, gaussian_weights(s)));
  }
  return filter;
}

LinearFilter LinearFilter::sharpened(double amount) const {
  LinearFilter filter = *this;
  filter.centre_ = 1 + amount;
  filter.scale_ = -amount;
  return filter;
}

std::array<int64_t, 3> LinearFilter::below() const {
  std::array<int64_t, 3> reach{};
  for (const Pass& pass : passes_)
    for (size_t axis = 0; axis < 3; ++axis) reach[axis] += pass.size[axis] / 2;
  return reach;
}

std::array<int64_t, 3> LinearFilter::above() const {
  std::array<int64_t, 3> reach{};
  for (const Pass& pass : passes_)
    for (size_t axis = 0; axis < 3; ++axis) reach[axis] += pass.size[axis] - 1 - pass.size[axis] / 2;
  return reach;
}

Interval LinearFilter::range() const {
  // Bounds the results by the sums of positive and of negative weights, pass by pass.
  double least = 0, greatest = 1;
  for (const Pass& pass : passes_) {
    double negative = 0, positive = 0;
    for (const double w : pass.weights) (w < 0 ? negative : positive) += w;
    const double low = negative * greatest + positive * least, high = positive * greatest + negative * least;
    least = low;
    greatest = high;
  }
  const double a = scale_ * least, b = scale_ * greatest;
  constexpr double rounding = 1e-6;
  return {std::min(a, b) + std::min(centre_, 0.0) - rounding, std::max(a, b) + std::max(centre_, 0.0) + rounding};
}

NumberGrid LinearFilter::applied(const Pass& pass, const NumberGrid& grid, const StopFlag* stop) {
  NumberGrid made;
  for (size_t axis = 0; axis < 3; ++axis) made.size[axis] = grid.size[axis] - (pass.size[axis] - 1);
  design::check_stop(stop);
  made.values.assign(static_cast<size_t>(made.size[0] * made.size[1] * made.size[2]), 0.0);
  const int64_t width = made.size[0];
  for (int64_t k = 0; k < made.size[2]; ++k)
    for (int64_t j = 0; j < made.size[1]; ++j) {
      design::check_stop(stop);
      double* const to = made.values.data() + (k * made.size[1] + j) * width;
      const double* weight = pass.weights.data();
      for (int64_t z = 0; z < pass.size[2]; ++z)
        for (int64_t y = 0; y < pass.size[1]; ++y) {
          const double* const from = grid.values.data() + ((k + z) * grid.size[1] + j + y) * grid.size[0];
          for (int64_t x = 0; x < pass.size[0]; ++x, ++weight) {
            const double w = *weight;
            if (w == 0) continue;
            for (int64_t i = 0; i < width; ++i) to[i] += w * from[x + i];
          }
        }
    }
  return made;
}

NumberGrid LinearFilter::apply(const NumberGrid& grid, const StopFlag* stop) const {
  NumberGrid made;
  for (size_t n = 0; n < passes_.size(); ++n) made = applied(passes_[n], n == 0 ? grid : made, stop);
  if (passes_.empty()) made = grid;
  if (centre_ == 0 && scale_ == 1) return made;
  const std::array<int64_t, 3> first = below();
  size_t n = 0;
  for (int64_t k = 0; k < made.size[2]; ++k)
    for (int64_t j = 0; j < made.size[1]; ++j) {
      const double* own = grid.values.data() + ((k + first[2]) * grid.size[1] + j + first[1]) * grid.size[0] + first[0];
      for (int64_t i = 0; i < made.size[0]; ++i, ++n) made.values[n] = centre_ * own[i] + scale_ * made.values[n];
    }
  return made;
}

}  // namespace ombre::nodes
