// How a calibration computes values between its points, or from a named law.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ombre::calibration {

enum class Interpolant : uint8_t {
  pchip,          // monotone cubics of one input (F. N. Fritsch and J. Butland, 1984)
  linear,         // linear along each of one to three inputs, on a full grid of points
  log_linear,     // the same for logarithms of values
  mixture,        // rule of mixtures: the mean of the materials' values by their fractions
  log_mixture,    // the mean of the logarithms of the materials' values by their fractions
  kerner,         // inclusions in a matrix (E. H. Kerner, 1956)
  percolation,    // a power of the share above a threshold (S. Kirkpatrick, 1973)
  working_curve,  // depth to which a dose of light cures a resin (P. F. Jacobs, 1992)
};
// Returns the names, in the order of the enumeration.
const std::vector<std::string>& interpolant_names();
// True for those that interpolate between points; the others are laws with constants.
bool has_points(Interpolant interpolant);

// The constants of a law.
struct Constants {
  std::vector<double> values;  // of the rest alone, then of each input's material alone
  double poissons_ratio = 0;   // of the matrix, for kerner
  double threshold = 0;        // share at which percolation begins
  double exponent = 2;         // power of percolation
  double penetration = 0;      // of a working curve: the depth at which light has fallen to 1/e
  double critical = 0;         // of a working curve: the dose at which a resin gels
};

// Values at all combinations of keys of one to three inputs. The last input varies fastest.
class Grid {
 public:
  Grid() = default;
  Grid(std::vector<std::vector<double>> axes, std::vector<double> values);

  const std::vector<std::vector<double>>& axes() const { return axes_; }
  const std::vector<double>& values() const { return values_; }
  // Both return the value of the nearest point of the grid's box for points outside of it.
  double linear(std::span<const double> at) const { return linear(at, 0, 0); }
  double cubic(double at) const;
  // Returns 1 if values rise along the axis everywhere, -1 if they fall, else 0.
  int direction(size_t axis) const;

 private:
  double linear(std::span<const double> at, size_t axis, size_t offset) const;

  std::vector<std::vector<double>> axes_;
  std::vector<double> values_, slopes_;  // slopes of a single input's cubics
};

// Returns the value of a law at these fractions, one for each input; the rest takes what they leave. The input of a
// working curve is a dose.
double law_value(Interpolant law, const Constants& constants, std::span<const double> inputs);

}  // namespace ombre::calibration
