// Cubics through points that rise or fall wherever the points do.
#pragma once

#include <cstddef>
#include <vector>

namespace ombre {

// Returns the slopes at the points, as SciPy's PchipInterpolator has them: by F. N. Fritsch and J. Butland, 1984, and
// at the ends by the one-sided three-point rule in C. Moler, "Numerical computing with MATLAB", 2004. The x ascend.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y);

// Returns the cubic between the points n and n + 1, at the share `t` of the way from one to the other. It lies between
// their values.
double cubic_between(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& slopes,
                     size_t n, double t);

}  // namespace ombre
