// Closed axis-aligned boxes, which may be empty or unbounded.
#pragma once

#include <algorithm>
#include <limits>

#include "base/math/interval.h"
#include "base/math/vec.h"

namespace ombre {

struct Box {
  Vec3 lo{inf, inf, inf}, hi{-inf, -inf, -inf};
  static constexpr double inf = std::numeric_limits<double>::infinity();

  static Box empty() { return {}; }
  static Box everything() { return {{-inf, -inf, -inf}, {inf, inf, inf}}; }
  static Box centered(Vec3 half) { return {-half, half}; }

  bool is_empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  bool is_bounded() const { return !is_empty() && is_finite(lo) && is_finite(hi); }
  Vec3 size() const { return is_empty() ? Vec3{} : hi - lo; }
  Vec3 center() const { return 0.5 * (lo + hi); }
  Interval axis(int i) const { return {lo[i], hi[i]}; }
  bool contains(Vec3 p) const {
    return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
  }
  Box expanded(double by) const {
    if (is_empty()) return *this;
    return {lo - Vec3{by, by, by}, hi + Vec3{by, by, by}};
  }
  bool operator==(const Box&) const = default;
};

inline Box intersect(const Box& a, const Box& b) {
  const Box r{{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
              {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
  return r.is_empty() ? Box::empty() : r;
}

inline Box hull(const Box& a, const Box& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

// Returns the smallest box around the image of `box`. A side stays unbounded only if an unbounded axis of `box` maps to
// it.
Box image(const Affine& map, const Box& box);

}  // namespace ombre
