#include "base/math/monotone_cubic.h"

#include <algorithm>
#include <cmath>

namespace ombre {
namespace {

double end_slope(double h0, double h1, double m0, double m1) {
  const double slope = ((2 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
  if (slope * m0 <= 0) return 0;
  return m0 * m1 <= 0 && std::abs(slope) > 3 * std::abs(m0) ? 3 * m0 : slope;
}

}  // namespace

std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const size_t count = x.size();
  std::vector<double> slopes(count, 0), h, m;
  for (size_t n = 0; n + 1 < count; ++n) {
    h.push_back(x[n + 1] - x[n]);
    m.push_back((y[n + 1] - y[n]) / h.back());
  }
  if (count == 1) return slopes;
  if (count == 2) return {m[0], m[0]};
  for (size_t n = 1; n + 1 < count; ++n) {
    if (m[n - 1] * m[n] <= 0) continue;
    const double a = 2 * h[n] + h[n - 1], b = h[n] + 2 * h[n - 1];
    slopes[n] = (a + b) / (a / m[n - 1] + b / m[n]);
  }
  slopes.front() = end_slope(h[0], h[1], m[0], m[1]);
  slopes.back() = end_slope(h[count - 2], h[count - 3], m[count - 2], m[count - 3]);
  return slopes;
}

double cubic_between(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& slopes,
                     size_t n, double t) {
  const double h = x[n + 1] - x[n], s = 1 - t;
  const double value =
      y[n] * (1 + 2 * t) * s * s + y[n + 1] * t * t * (1 + 2 * s) + h * t * s * (slopes[n] * s - slopes[n + 1] * t);
  // Enforces monotonicity against rounding errors.
  return std::clamp(value, std::min(y[n], y[n + 1]), std::max(y[n], y[n + 1]));
}

}  // namespace ombre
