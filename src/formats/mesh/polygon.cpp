// Triangulates polygons by ear clipping.
#include "formats/mesh/polygon.h"

#include <algorithm>
#include <cmath>

#include "base/system/assert.h"

namespace ombre::formats {
namespace {

// Limit on point-in-ear tests per corner, which bounds the time for malicious polygons; beyond it, corners are clipped
// without tests.
constexpr size_t most_tests_per_corner = 2000;

// Returns twice the polygon's area vector (Newell), relative to its first corner to keep precision.
Vec3 area_vector(std::span<const Vec3> corners) {
  Vec3 sum;
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    sum = sum + cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

}  // namespace

// Returns a positive number if a, b and c turn left.
double PolygonCutter::turn(Point a, Point b, Point c) { return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u); }

const std::vector<Corners>& PolygonCutter::cut(std::span<const Vec3> corners) {
  ASSERT(corners.size() >= 3);
  triangles_.clear();
  if (corners.size() == 3) {
    triangles_.push_back({0, 1, 2});
    return triangles_;
  }
  flatten(corners);
  find_reflex();

  size_t tests_left = most_tests_per_corner * corners.size();
  size_t left = corners.size(), stalled = 0;
  uint32_t corner = 1;
  while (left > 3) {
    const uint32_t following = next_[corner];
    // A whole round found no ear, so the polygon crosses itself.
    if (stalled >= left || tests_left == 0 || is_ear(corner, tests_left)) {
      if (tests_left == 0) reflex_.clear();
      clip(corner);
      --left;
      stalled = 0;
    } else {
      ++stalled;
    }
    corner = following;
  }
  triangles_.push_back({previous_[corner], corner, next_[corner]});
  return triangles_;
}

// Projects along the axis nearest to the normal, which causes no rounding and keeps convex corners convex.
void PolygonCutter::flatten(std::span<const Vec3> corners) {
  const Vec3 normal = area_vector(corners);
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
  const double sign = normal[axis] < 0 ? -1 : 1;
  points_.clear();
  for (const Vec3& p : corners) points_.push_back({sign * p[(axis + 1) % 3], p[(axis + 2) % 3]});
}

void PolygonCutter::find_reflex() {
  const auto n = static_cast<uint32_t>(points_.size());
  next_.resize(n);
  previous_.resize(n);
  for (uint32_t i = 0; i < n; ++i) {
    next_[i] = i + 1 < n ? i + 1 : 0;
    previous_[i] = i > 0 ? i - 1 : n - 1;
  }
  reflex_.clear();
  for (uint32_t i = 0; i < n; ++i)
    if (!is_convex(i)) reflex_.push_back(i);
}

bool PolygonCutter::is_convex(uint32_t corner) const {
  return turn(points_[previous_[corner]], points_[corner], points_[next_[corner]]) > 0;
}

bool PolygonCutter::is_ear(uint32_t corner, size_t& tests_left) const {
  if (tests_left > 0) --tests_left;
  if (!is_convex(corner)) return false;
  const Point a = points_[previous_[corner]], b = points_[corner], c = points_[next_[corner]];
  for (const uint32_t other : reflex_) {
    if (tests_left > 0) --tests_left;
    const Point p = points_[other];
    // A slit that joins a hole to the outline visits a place twice.
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

void PolygonCutter::clip(uint32_t corner) {
  const uint32_t before = previous_[corner], after = next_[corner];
  triangles_.push_back({before, corner, after});
  next_[before] = after;
  previous_[after] = before;
  const auto is_done = [&](uint32_t other) {
    return other == corner || ((other == before || other == after) && is_convex(other));
  };
  reflex_.erase(std::remove_if(reflex_.begin(), reflex_.end(), is_done), reflex_.end());
}

}  // namespace ombre::formats
