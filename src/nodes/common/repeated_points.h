// Removal of repeated points from outlines and paths of drawings and computations.
#pragma once

#include <vector>

#include "base/math/box.h"

namespace ombre::nodes {

// Tolerance for rounding of points, relative to the size of the outline or path.
inline constexpr double noise_of_points = 1e-11;

inline double size_of(const std::vector<Vec3>& points) {
  Box box;
  for (const Vec3& p : points) box = hull(box, Box{p, p});
  return length(box.size());
}

// Merges consecutive equal points. For closed outlines, the last point is also removed if it equals the first.
template <class P>
std::vector<P> without_repeated(const std::vector<P>& points, double size, bool go_round) {
  const double room = noise_of_points * size;
  std::vector<P> kept;
  for (const P& p : points)
    if (kept.empty() || length(p - kept.back()) > room) kept.push_back(p);
  while (go_round && kept.size() > 1 && length(kept.back() - kept.front()) <= room) kept.pop_back();
  return kept;
}

}  // namespace ombre::nodes
