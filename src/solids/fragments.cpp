#include "solids/fragments.h"

#include <algorithm>
#include <numbers>

namespace ombre::solids {
namespace {

constexpr double least_radius_mm = 1e-6;  // smaller circles are points

int limited(double edges) { return static_cast<int>(std::min(edges, static_cast<double>(most_edges))); }

}  // namespace

int edges_of_circle(double radius_mm, const Fragments& fragments) {
  constexpr double least_step = 0.01, fewest = 5;
  if (!(radius_mm >= least_radius_mm) || !std::isfinite(fragments.count)) return 3;
  if (fragments.count > 0) return std::max(3, limited(fragments.count));
  const double by_angle = 360 / std::max(fragments.angle, least_step);
  const double by_size = 2 * std::numbers::pi * radius_mm / std::max(fragments.size, least_step);
  return limited(std::ceil(std::max(std::min(by_angle, by_size), fewest)));
}

}  // namespace ombre::solids
