#include "nodes/lattices/turned_copies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/math.h"

namespace ombre::nodes {
namespace {

using program::Field;
using program::Point;

// Up to this number of copies, evaluating all costs less than finding those that matter.
constexpr int few_turned = 8;
// Tolerances relative to the greatest coordinate, and of an angle in degrees, since the choice of copies may be
// computed in single precision.
constexpr double rounding_mm = 1e-6, rounding_degrees = 1e-3;
constexpr Vec3 z_axis{0, 0, 1};

}  // namespace

TurnedCopies::TurnedCopies(const Affine& turn_from_here, const Affine& turn_from_original, int count, double degrees,
                           bool is_full, const Box& bounds)
    : turn_from_here_(turn_from_here),
      turn_from_original_(turn_from_original),
      count_(count),
      degrees_(degrees),
      is_full_(is_full),
      candidates_(count) {
  if (count <= few_turned) return;
  find_sector(bounds);
  const double room = is_full ? 180 : half_degrees_ + (count - 1) * std::abs(degrees) / 2;
  if (half_degrees_ >= 180 || (!is_full && room >= 180)) return;
  candidates_ = static_cast<int>(std::min<double>(count, std::floor(2 * half_degrees_ / std::abs(degrees)) + 1));
}

// Computes the sector of the bounds. If the box does not contain the axis, its corners have the extreme angles.
void TurnedCopies::find_sector(const Box& bounds) {
  if (bounds.is_empty()) return;
  Box box = image(turn_from_original_, bounds);
  box = box.expanded(rounding_mm * (1 + length(box.lo) + length(box.hi)));
  if (box.lo.x <= 0 && box.hi.x >= 0 && box.lo.y <= 0 && box.hi.y >= 0) return;
  const Vec3 c = box.center();
  middle_degrees_ = math::atan2(c.y, c.x) / math::degree;
  half_degrees_ = rounding_degrees;
  for (const double x : {box.lo.x, box.hi.x})
    for (const double y : {box.lo.y, box.hi.y}) {
      const double turn = std::remainder(math::atan2(y, x) / math::degree - middle_degrees_, 360.0);
      half_degrees_ = std::max(half_degrees_, std::abs(turn) + rounding_degrees);
    }
}

std::vector<Point> TurnedCopies::holding(const Point& p) const {
  if (candidates_ == count_) return all(p);
  // Angles are measured from the middle of the first copy, or of all copies, so that the jump of atan2 lies where there
  // are none.
  const double before = is_full_ ? 0 : (count_ - 1) / 2.0;
  const Affine level = Affine::rotation(z_axis, -(middle_degrees_ + before * degrees_));
  const Point q = p.mapped(turn_from_here_), seen = q.mapped(level);
  const Field angle = p.builder().apply(program::Op::atan2, seen.y, seen.x);
  const Field reached = angle / (degrees_ * math::degree) + (before - half_degrees_ / std::abs(degrees_));
  Field first = ceil(reached);
  if (!is_full_) first = min(max(first, 0.0), p.constant(count_ - candidates_));

  const Field turn = first * (degrees_ * math::degree);
  const Field c = cos(turn), s = sin(turn);
  const Point turned = q.moved_to(q.x * c + q.y * s, q.y * c - q.x * s, q.z);
  std::vector<Point> points;
  for (int n = 0; n < candidates_; ++n)
    points.push_back(turned.mapped(inverse(turn_from_original_) * Affine::rotation(z_axis, -n * degrees_)));
  return points;
}

std::vector<Point> TurnedCopies::all(const Point& p) const {
  std::vector<Point> points;
  for (int n = 0; n < count_; ++n) points.push_back(p.mapped(inverse(place(n))));
  return points;
}

Affine TurnedCopies::place(int copy) const {
  return inverse(turn_from_here_) * Affine::rotation(z_axis, copy * degrees_) * turn_from_original_;
}

Box TurnedCopies::originals(const Box& where) const {
  const Box there = image(turn_from_here_, where);
  if (there.is_empty()) return there;
  const double x = std::max(std::abs(there.lo.x), std::abs(there.hi.x)),
               y = std::max(std::abs(there.lo.y), std::abs(there.hi.y));
  const double r = std::sqrt(x * x + y * y);
  return image(inverse(turn_from_original_), {{-r, -r, there.lo.z}, {r, r, there.hi.z}});
}

Box TurnedCopies::copies(const Box& reached, const Box& where) const {
  Box result;
  for (int n = 0; n < count_; ++n) result = hull(result, intersect(image(place(n), reached), where));
  return result;
}

}  // namespace ombre::nodes
