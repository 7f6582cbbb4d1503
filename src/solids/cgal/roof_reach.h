// Which sides of an outline the roof's wave from an inward corner can meet.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "base/math/vec.h"

namespace ombre::solids {

// A side of an outline, with the inside on the left.
struct RoofSide {
  Vec2 from, to;
};

// Returns the largest angle in radians by which rings turn away from the inside at a corner.
inline double largest_inward_turn(std::span<const std::vector<Vec2>> rings) {
  double largest = 0;
  for (const auto& ring : rings)
    for (size_t n = 0; n < ring.size(); ++n) {
      const Vec2 in = ring[n] - ring[(n + ring.size() - 1) % ring.size()], out = ring[(n + 1) % ring.size()] - ring[n];
      if (cross(in, out) < 0) largest = std::max(largest, std::atan2(-cross(in, out), dot(in, out)));
    }
  return largest;
}

// Angle up to which waves are like circles around their corners: they travel little farther than they rise, and meet
// sides little beyond the ends.
inline constexpr double most_inward_turn = std::numbers::pi / 4;

// The path on which the roof's wave leaves an inward corner.
struct CornerPath {
  Vec2 corner, direction;

  // Returns the radius of the smallest circle that has its centre on the path and touches the corner and a side;
  // infinity if none does. The side is longer at both ends by `excess` of the radius.
  double touching_radius(const RoofSide& side, double excess = 0) const {
    const double radius = std::min(radius_through(side.from), radius_through(side.to));
    const double span = length(side.to - side.from);
    const Vec2 along = (1 / span) * (side.to - side.from), normal{-along.y, along.x};
    const double above = dot(corner - side.from, normal), closing = 1 - dot(direction, normal);
    if (above <= 0 || closing <= 0) return radius;
    const double at = above / closing, foot = dot(corner + at * direction - side.from, along);
    return foot >= -excess * at && foot <= span + excess * at ? std::min(radius, at) : radius;
  }

  // Returns the height that the wave cannot pass: it is that of the largest circle inside the outline.
  double most_height(std::span<const RoofSide> sides) const {
    double least = std::numeric_limits<double>::infinity();
    for (const RoofSide& side : sides)
      if (side.from != corner && side.to != corner) least = std::min(least, touching_radius(side));
    return least;
  }

  // Returns false for a side that the wave cannot meet before it reaches a height.
  bool can_meet(const RoofSide& side, double height) const {
    constexpr double excess = 0.5, slack = 1.5;  // corners are not round, and waves no circles
    return touching_radius(side, excess) <= slack * height;
  }

 private:
  double radius_through(Vec2 p) const {
    const double ahead = dot(p - corner, direction);
    return ahead > 0 ? dot(p - corner, p - corner) / (2 * ahead) : std::numeric_limits<double>::infinity();
  }
};

}  // namespace ombre::solids
