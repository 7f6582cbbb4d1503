// Random points in a solid that keep a distance from each other.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"

namespace ombre::nodes {

// The part of space that gets points.
struct PointHost {
  Box box;  // bounded; contains the host
  // Returns g of the host, which is negative inside, and the wanted least distance (mm) between points here.
  std::function<std::array<double, 2>(Vec3 p, std::vector<double>& memory)> at;
  // Returns intervals around both in a box.
  std::function<std::array<Interval, 2>(const Box& box)> range;
};

struct PointRules {
  uint64_t seed = 0;
  int relaxations = 0;    // steps of Lloyd's algorithm
  double clearance = 0;   // least distance of points from the border of the host, mm
  size_t most = 2000000;  // more points are a problem
};

struct ScatteredPoints {
  std::vector<Vec3> points;
  std::string problem, hint;  // what is wrong, for a message, or empty; what to do about it
};

// The number of points that fill a volume, times the cube of their distance: balls of that diameter that random
// sequential addition saturates space with fill 0.38413 of it (G. Zhang and S. Torquato, Physical Review E 88, 2013).
inline constexpr double points_per_cubed_distance = 0.38413 * 6 / 3.14159265358979323846;

// Returns points in a fixed order that depends on the host and the rules alone. Two points are nowhere closer than the
// wanted distance at either of them. Where that is constant, no place that points may lie in is farther than 1.2 times
// of it from the nearest point, unless the host is thinner than that.
// Source: maximal Poisson-disc sampling after Ebeida, Mitchell, Patney, Davidson and Owens, "A simple algorithm for
// maximal Poisson-disk sampling in high dimensions", Computer Graphics Forum 31, 2012. Darts are thrown into cells, and
// cells without a disc are divided. With relaxations, points move towards the weighted centres of their Voronoi cells
// as far as their distances allow it.
ScatteredPoints scatter_points(const PointHost& host, const PointRules& rules);

}  // namespace ombre::nodes
