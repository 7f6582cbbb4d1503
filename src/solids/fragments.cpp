#include "solids/fragments.h"

#include <algorithm>
#include <numbers>

#include "base/math/math.h"

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

double sine(double degrees) {
  const double turn = std::remainder(degrees, 360);  // the remainder is exact
  if (std::abs(turn) > 90) return std::copysign(sine(180 - std::abs(turn)), turn);
  if (std::abs(turn) == 90) return std::copysign(1, turn);
  if (std::abs(turn) == 30) return std::copysign(0.5, turn);
  return turn == 0 ? 0 : math::sin(turn * std::numbers::pi / 180);
}

double cosine(double degrees) {
  const double turn = std::abs(std::remainder(degrees, 360));
  if (turn == 90) return 0;
  if (turn > 90) return -cosine(180 - turn);
  if (turn == 60) return 0.5;
  return turn == 0 ? 1 : turn > 45 ? sine(90 - turn) : math::cos(turn * std::numbers::pi / 180);
}

}  // namespace ombre::solids
