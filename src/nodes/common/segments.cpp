#include "nodes/common/segments.h"

#include <cmath>

namespace ombre::nodes {

using program::Field;
using program::Point;

namespace {

// Returns the part of the segment, as shares from 0 at its start to 1 at its end, whose surroundings intersect the box.
// lo > hi if there is none.
Interval reached(Vec3 start, Vec3 end, Vec3 margins, const Box& where) {
  Interval shares{0, 1};
  for (int axis = 0; axis < 3; ++axis) {
    const double rounding = 1e-12 * (1 + std::abs(start[axis]) + std::abs(end[axis]));
    const double lo = where.lo[axis] - margins[axis] - rounding - start[axis];
    const double hi = where.hi[axis] + margins[axis] + rounding - start[axis];
    const double along = end[axis] - start[axis];
    if (along == 0) {
      if (lo > 0 || hi < 0) return {1, 0};
      continue;
    }
    shares.lo = std::max(shares.lo, std::min(lo / along, hi / along));
    shares.hi = std::min(shares.hi, std::max(lo / along, hi / along));
  }
  return shares;
}

}  // namespace

Field Segment::along(const Point& p) const {
  const Vec3 d = end - start, u = (1 / dot(d, d)) * d;
  const Field share = (p.x - start.x) * u.x + (p.y - start.y) * u.y + (p.z - start.z) * u.z;
  return min(max(share, 0.0), p.constant(1));
}

Field Segment::squared_distance(const Point& p) const {
  const Vec3 d = end - start;
  const Field t = along(p);
  return square(p.x - start.x - t * d.x) + square(p.y - start.y - t * d.y) + square(p.z - start.z - t * d.z);
}

Box reach_of_segment(Vec3 start, Vec3 end, Vec3 margins, const Box& where) {
  const Interval part = reached(start, end, margins, where);
  if (part.lo > part.hi) return Box::empty();
  const Vec3 along = end - start, from = start + part.lo * along, to = start + part.hi * along;
  const Box axis = hull(Box{from, from}, Box{to, to});
  return {axis.lo - margins, axis.hi + margins};
}

}  // namespace ombre::nodes
