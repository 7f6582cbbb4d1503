// Spectra of voxel patterns, which measure how visible their noise is.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace ombre::voxel {

// A square of n x n voxels, 1 where a material is and 0 elsewhere.
struct SquarePattern {
  int64_t n = 64;
  std::vector<double> values;  // x varies fastest

  SquarePattern(int64_t size, const std::function<bool(int64_t i, int64_t j)>& is_set) : n(size) {
    for (int64_t j = 0; j < n; ++j)
      for (int64_t i = 0; i < n; ++i) values.push_back(is_set(i, j) ? 1 : 0);
  }
};

// Power by distance from the centre of the frequency plane, relative to that of white noise with the same fraction.
class Spectrum {
 public:
  // Computes the mean power of all patterns by a plain discrete Fourier transform along x, then y.
  Spectrum(const std::vector<SquarePattern>& patterns, double fraction) : n_(patterns.front().n) {
    power_.resize(static_cast<size_t>(n_ * n_));
    const double white =
        fraction * (1 - fraction) * static_cast<double>(n_ * n_) * static_cast<double>(patterns.size());
    for (const SquarePattern& pattern : patterns) {
      std::vector<std::complex<double>> values;
      for (const double value : pattern.values) values.emplace_back(value - fraction);
      transform(values, n_, 1);
      transform(values, 1, n_);
      for (size_t q = 0; q < values.size(); ++q) power_[q] += std::norm(values[q]) / white;
    }
  }

  // Returns the mean power over frequencies in (from, to], in cycles per voxel, without the constant term.
  double mean(double from, double to) const {
    double sum = 0, count = 0;
    for (int64_t y = 0; y < n_; ++y)
      for (int64_t x = 0; x < n_; ++x) {
        const double q = std::hypot(std::min(x, n_ - x), std::min(y, n_ - y)) / static_cast<double>(n_);
        if (q == 0 || q <= from || q > to) continue;
        sum += power_[static_cast<size_t>(y * n_ + x)];
        ++count;
      }
    return sum / count;
  }

  // Returns the mean power of waves whose direction is within about 26 degrees of an axis, x or y. Voxels are `y_per_x`
  // times as long along y as along x. Frequencies are in cycles per side of a square with the area of a voxel.
  double mean_along(int axis, double from, double to, double y_per_x) const {
    double sum = 0, count = 0;
    for (int64_t y = 0; y < n_; ++y)
      for (int64_t x = 0; x < n_; ++x) {
        const double along_x = static_cast<double>(std::min(x, n_ - x)) / static_cast<double>(n_) * std::sqrt(y_per_x),
                     along_y = static_cast<double>(std::min(y, n_ - y)) / static_cast<double>(n_) / std::sqrt(y_per_x);
        const double q = std::hypot(along_x, along_y);
        const bool runs_along = axis == 0 ? along_x > 2 * along_y : along_y > 2 * along_x;
        if (!runs_along || q <= from || q > to) continue;
        sum += power_[static_cast<size_t>(y * n_ + x)];
        ++count;
      }
    return sum / count;
  }

  // Returns the power of visible unevenness, with periods of more than 8 voxels.
  double low() const { return mean(0, 0.125); }

 private:
  // Transforms all lines. Lines begin `between` values apart, and the values of a line are `step` apart.
  void transform(std::vector<std::complex<double>>& values, int64_t between, int64_t step) const {
    std::vector<std::complex<double>> turns, line(static_cast<size_t>(n_));
    for (int64_t t = 0; t < n_; ++t)
      turns.push_back(std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(t) / static_cast<double>(n_)));
    for (int64_t begin = 0; begin < n_; ++begin) {
      for (int64_t q = 0; q < n_; ++q) {
        std::complex<double> sum;
        for (int64_t t = 0; t < n_; ++t)
          sum += values[static_cast<size_t>(begin * between + t * step)] * turns[static_cast<size_t>(q * t % n_)];
        line[static_cast<size_t>(q)] = sum;
      }
      for (int64_t q = 0; q < n_; ++q)
        values[static_cast<size_t>(begin * between + q * step)] = line[static_cast<size_t>(q)];
    }
  }

  int64_t n_;
  std::vector<double> power_;
};

// Returns the variance of a material's share in all patches of m x m voxels, including those that wrap around the
// edges, relative to that of white noise.
inline double patch_variance(const SquarePattern& pattern, int64_t m, double fraction) {
  const int64_t n = pattern.n;
  double sum = 0;
  for (int64_t y = 0; y < n; ++y)
    for (int64_t x = 0; x < n; ++x) {
      double set = 0;
      for (int64_t b = 0; b < m; ++b)
        for (int64_t a = 0; a < m; ++a) set += pattern.values[static_cast<size_t>((y + b) % n * n + (x + a) % n)];
      sum += std::pow(set / static_cast<double>(m * m) - fraction, 2);
    }
  const double white = fraction * (1 - fraction) / static_cast<double>(m * m);
  return sum / static_cast<double>(n * n) / white;
}

}  // namespace ombre::voxel
