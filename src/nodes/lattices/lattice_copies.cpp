#include "nodes/lattices/lattice_copies.h"

#include <algorithm>
#include <cmath>

#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

// Up to this number of copies, evaluating all costs less than finding those that matter.
constexpr int few_in_lattice = 16;
// Tolerance relative to the greatest coordinate, since the choice of copies may be computed in single precision.
constexpr double rounding = 1e-6;

Interval multiplied(double factor, Interval v) {
  return factor < 0 ? Interval(factor * v.hi, factor * v.lo) : Interval(factor * v.lo, factor * v.hi);
}

}  // namespace

LatticeCopies::LatticeCopies(const Affine& frame_from_here, const std::array<Row, 3>& rows, const Box& bounds)
    : frame_from_here_(frame_from_here), rows_(rows), original_(bounds) {
  box_ = bounds.is_empty() ? Box{{0, 0, 0}, {0, 0, 0}} : image(frame_from_here, bounds);
  for (size_t axis = 0; axis < 3; ++axis) steps_[axis] = dot(frame_from_here.rows[axis], rows[axis].step);
  const Box all = hull();
  box_ = box_.expanded(rounding * (1 + length(all.lo) + length(all.hi)));
  holding_ = window(0);
  // Greatest distance from a point between the copies to the nearest copy: the extent of a cell and of the box.
  Vec3 farthest;
  const Vec3 size = box_.size();
  for (int axis = 0; axis < 3; ++axis) {
    const double step = rows_[static_cast<size_t>(axis)].count > 1 ? std::abs(steps_[static_cast<size_t>(axis)]) : 0;
    farthest[axis] = 0.5 * (std::max(step, size[axis]) + size[axis]);
  }
  around_ = window(length(farthest));
}

LatticeCopies::Window LatticeCopies::window(double reach_mm) const {
  Window result;
  result.reach_mm = reach_mm;
  const bool are_few = double{1} * rows_[0].count * rows_[1].count * rows_[2].count <= few_in_lattice;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int count = rows_[axis].count;
    const double mm = box_.size()[static_cast<int>(axis)] + 2 * reach_mm;
    const double reached = count == 1 ? 1 : std::floor(mm / std::abs(steps_[axis])) + 1;
    result.counts[axis] = are_few || reached >= count ? count : static_cast<int>(reached);
  }
  return result;
}

bool LatticeCopies::has_all(const Window& window) const {
  for (size_t axis = 0; axis < 3; ++axis)
    if (window.counts[axis] < rows_[axis].count) return false;
  return true;
}

bool LatticeCopies::queries_all() const { return has_all(around_); }

double LatticeCopies::around_count() const {
  return double{1} * around_.counts[0] * around_.counts[1] * around_.counts[2];
}

Interval LatticeCopies::in_steps(size_t axis, Interval mm) const { return multiplied(1 / steps_[axis], mm); }

std::vector<Point> LatticeCopies::holding(const Point& p) const { return candidates(p, holding_); }
std::vector<Point> LatticeCopies::around(const Point& p) const { return candidates(p, around_); }

std::vector<Point> LatticeCopies::candidates(const Point& p, const Window& window) const {
  // Finds the first copy of the window along each axis. Unless the window contains all copies, its number depends on
  // the point.
  Point first = p;
  if (!has_all(window)) {
    const Point q = p.mapped(frame_from_here_);
    const std::array<Field, 3> places{q.x, q.y, q.z};
    std::array<Field, 3> moved{p.x, p.y, p.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      const int most = rows_[axis].count - window.counts[axis];
      if (most == 0) continue;
      const int i = static_cast<int>(axis);
      const Interval reach{box_.lo[i] - window.reach_mm, box_.hi[i] + window.reach_mm};
      const Field number = ceil(places[axis] / steps_[axis] - in_steps(axis, reach).hi);
      const Field begin = min(max(number, 0.0), p.constant(most));
      for (size_t c = 0; c < 3; ++c)
        if (const double step = rows_[axis].step[static_cast<int>(c)]; step != 0) moved[c] = moved[c] - begin * step;
    }
    first = p.moved_to(moved[0], moved[1], moved[2]);
  }
  std::vector<Point> points;
  for (int k = 0; k < window.counts[2]; ++k)
    for (int j = 0; j < window.counts[1]; ++j)
      for (int i = 0; i < window.counts[0]; ++i)
        points.push_back(first.mapped(
            Affine::translation(-(double(i) * rows_[0].step + double(j) * rows_[1].step + double(k) * rows_[2].step))));
  return points;
}

Box LatticeCopies::hull() const {
  Box all = box_;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    const double last = (rows_[axis].count - 1) * steps_[axis];
    all.lo[i] += std::min(0.0, last);
    all.hi[i] += std::max(0.0, last);
  }
  return all;
}

Field LatticeCopies::distance_of_others(const Point& p) const {
  const Point q = p.mapped(frame_from_here_);
  const Box all = hull();
  const Vec3 c = all.center(), h = 0.5 * all.size();
  const Field outside =
      length(max(abs(q.x - c.x) - h.x, 0.0), max(abs(q.y - c.y) - h.y, 0.0), max(abs(q.z - c.z) - h.z, 0.0));
  return max(outside, around_.reach_mm);
}

Field LatticeCopies::distance_of_box(const Point& p) const {
  const Point q = p.mapped(frame_from_here_);
  const Vec3 c = box_.center(), h = 0.5 * box_.size();
  return corner(abs(q.x - c.x) - h.x, abs(q.y - c.y) - h.y, abs(q.z - c.z) - h.z);
}

LatticeCopies::Part LatticeCopies::part(const Box& where, const Box& reachable) const {
  Part result;
  if (where.is_empty() || reachable.is_empty()) return result;
  const Box there = image(frame_from_here_, where), reached = image(frame_from_here_, reachable);
  result.originals = where;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int n = rows_[axis].count, i = static_cast<int>(axis);
    if (n == 1) continue;
    const Interval t = in_steps(axis, there.axis(i)), box = in_steps(axis, reached.axis(i));
    const double first = std::max(0.0, std::ceil(t.lo - box.hi - 1e-6)),
                 last = std::min(n - 1.0, std::floor(t.hi - box.lo + 1e-6));
    if (first > last) return {};
    const Vec3 a = first * rows_[axis].step, b = last * rows_[axis].step;
    const Box moves = ombre::hull(Box{a, a}, Box{b, b});
    result.least = result.least + moves.lo;
    result.greatest = result.greatest + moves.hi;
  }
  result.originals = {where.lo - result.greatest, where.hi - result.least};
  return result;
}

Box LatticeCopies::others(double margin) const {
  if (queries_all() || margin < around_.reach_mm) return Box::empty();
  return image(inverse(frame_from_here_), hull().expanded(margin));
}

}  // namespace ombre::nodes
