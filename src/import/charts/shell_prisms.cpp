#include "import/charts/shell_prisms.h"

#include <cmath>

#include "base/math/math.h"

namespace ombre::importing {

namespace {

// Shares of the shell's height by which prisms reach beyond it, so that its border lies within.
constexpr double beyond = 1e-3;
constexpr double most_slabs = 16;

Interval around(std::initializer_list<double> values) { return {std::min(values), std::max(values)}; }

// Returns the least value of a quadratic polynomial in an interval.
double least_of(const std::array<double, 3>& c, Interval t) {
  const auto at = [&](double v) { return c[0] + v * (c[1] + v * c[2]); };
  double least = std::min(at(t.lo), at(t.hi));
  if (c[2] > 0) least = std::min(least, at(std::clamp(-c[1] / (2 * c[2]), t.lo, t.hi)));
  return least;
}
double greatest_of(std::array<double, 3> c, Interval t) {
  for (double& v : c) v = -v;
  return -least_of(c, t);
}

using Intervals = std::array<Interval, 3>;

Intervals moving(Vec3 from, Vec3 by, Interval t) {
  Intervals all;
  for (int n = 0; n < 3; ++n) all[static_cast<size_t>(n)] = around({from[n] + t.lo * by[n], from[n] + t.hi * by[n]});
  return all;
}
Interval minus(Interval a, Interval b) { return math::subtract(a, b); }
Intervals cross_of(const Intervals& a, const Intervals& b) {
  using math::multiply;
  return {minus(multiply(a[1], b[2]), multiply(a[2], b[1])), minus(multiply(a[2], b[0]), multiply(a[0], b[2])),
          minus(multiply(a[0], b[1]), multiply(a[1], b[0]))};
}

}  // namespace

Prism::Prism(const Shell& shell, const Corners& corners) {
  const auto [a, b, c] = corners;
  n_.x0 = shell.patch.points[a];
  n_.e1 = shell.patch.points[b] - n_.x0;
  n_.e2 = shell.patch.points[c] - n_.x0;
  n_.w0 = shell.ways[a];
  n_.m1 = shell.ways[b] - n_.w0;
  n_.m2 = shell.ways[c] - n_.w0;
  n_.c0 = cross(n_.e1, n_.e2);
  n_.c1 = cross(n_.e1, n_.m2) + cross(n_.m1, n_.e2);
  n_.c2 = cross(n_.m1, n_.m2);
}

Box Prism::box(Interval heights) const {
  Box box;
  for (const double t : {heights.lo, heights.hi})
    for (const auto& [b, c] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)}) {
      const Vec3 p = point({b, c, t});
      box = hull(box, Box{p, p});
    }
  return box;
}

// The point lies in the plane of the triangle at its height, which is a cubic equation. Between the heights it has one
// root if the signs at both differ, as they do for points of the prism.
bool Prism::find(Vec3 p, Interval heights, PrismPlace& place) const {
  const Vec3 q = p - n_.x0;
  const double a0 = dot(q, n_.c0), a1 = dot(q, n_.c1) - dot(n_.w0, n_.c0), a2 = dot(q, n_.c2) - dot(n_.w0, n_.c1),
               a3 = -dot(n_.w0, n_.c2);
  const auto at = [&](double t) { return a0 + t * (a1 + t * (a2 + t * a3)); };
  double lo = heights.lo, hi = heights.hi;
  if (at(lo) < 0 || at(hi) > 0) return false;
  double t = std::clamp(a1 != 0 ? -a0 / a1 : lo, lo, hi);
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step) {
    const double value = at(t), slope = a1 + t * (2 * a2 + 3 * t * a3);
    (value > 0 ? lo : hi) = t;
    double next = slope < 0 ? t - value / slope : 0.5 * (lo + hi);
    if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
    const bool is_last = std::abs(next - t) <= 1e-14 * (heights.hi - heights.lo);
    t = next;
    if (is_last) break;
  }
  const Vec3 e1 = edge(1, t), e2 = edge(2, t), n = cross(e1, e2), way = q - t * n_.w0;
  const double squared = dot(n, n);
  place = {dot(cross(way, e2), n) / squared, dot(cross(e1, way), n) / squared, t};
  return true;
}

PrismPlace Prism::nearest(Vec3 p) const {
  const Vec3 q = p - n_.x0;
  const double squared = dot(n_.c0, n_.c0);
  double b = dot(cross(q, n_.e2), n_.c0) / squared, c = dot(cross(n_.e1, q), n_.c0) / squared;
  if (std::min({b, c, 1 - b - c}) < 0) {
    // The nearest point lies on one of the edges.
    const auto along = [&](Vec3 from, Vec3 way) { return std::clamp(dot(q - from, way) / dot(way, way), 0.0, 1.0); };
    const double first = along({}, n_.e1), second = along({}, n_.e2), third = along(n_.e1, n_.e2 - n_.e1);
    double best = Box::inf;
    for (const auto& [x, y] : {std::pair(first, 0.0), std::pair(0.0, second), std::pair(1 - third, third)}) {
      const Vec3 off = q - x * n_.e1 - y * n_.e2;
      if (dot(off, off) >= best) continue;
      best = dot(off, off);
      b = x;
      c = y;
    }
  }
  const Vec3 off = q - b * n_.e1 - c * n_.e2;
  const double rise = dot(way({b, c, 0}), n_.c0);
  return {b, c, rise > 0 ? dot(off, n_.c0) / rise : 0};
}

Interval Prism::heights_of(const Box& box) const {
  const Vec3 middle = box.center(), half = 0.5 * box.size();
  const double reach = std::abs(n_.c0.x) * half.x + std::abs(n_.c0.y) * half.y + std::abs(n_.c0.z) * half.z;
  const double value = dot(middle - n_.x0, n_.c0),
               room = 1e-12 * (std::abs(value) + reach + length(n_.c0) * length(middle));
  double least = Box::inf, most = 0;
  for (int n = 0; n < 3; ++n) {
    least = std::min(least, dot(corner_way(n), n_.c0));
    most = std::max(most, dot(corner_way(n), n_.c0));
  }
  if (!(least > 0)) return Interval::everything();
  const double lo = value - reach - room, hi = value + reach + room;
  return {lo / (lo < 0 ? least : most), hi / (hi < 0 ? most : least)};
}

Prism::Slopes Prism::slopes(const PrismPlace& at) const {
  const Vec3 e1 = edge(1, at.height), e2 = edge(2, at.height), n = cross(e1, e2), w = way(at);
  const double inverse = 1 / dot(n, w);
  return {inverse * cross(e2, w), inverse * cross(w, e1), inverse * n};
}

std::array<std::array<Interval, 3>, 3> Prism::slope_ranges(Interval heights) const {
  const Intervals e1 = moving(n_.e1, n_.m1, heights), e2 = moving(n_.e2, n_.m2, heights);
  Intervals w, n;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    w[a] = around({corner_way(0)[axis], corner_way(1)[axis], corner_way(2)[axis]});
    const std::array<double, 3> normal{n_.c0[axis], n_.c1[axis], n_.c2[axis]};
    n[a] = {least_of(normal, heights), greatest_of(normal, heights)};
  }
  Interval turn{Box::inf, -Box::inf};
  for (int corner = 0; corner < 3; ++corner) {
    turn.lo = std::min(turn.lo, least_of(turns(corner), heights));
    turn.hi = std::max(turn.hi, greatest_of(turns(corner), heights));
  }
  std::array<Intervals, 3> all{cross_of(e2, w), cross_of(w, e1), n};
  for (Intervals& three : all)
    for (Interval& one : three) one = math::divide(one, turn);
  return all;
}

Prisms::Prisms(const Shell& shell) {
  const double room = beyond * (shell.heights.hi - shell.heights.lo);
  heights_ = {shell.heights.lo - room, shell.heights.hi + room};
  double areas = 0, ways = 0;
  for (const Corners& corners : shell.patch.triangles) {
    all_.emplace_back(shell, corners);
    areas += 0.5 * length(all_.back().normal(0));
    ways += length(all_.back().way({1.0 / 3, 1.0 / 3, 0}));
  }
  const double count = static_cast<double>(all_.size()), span = heights_.hi - heights_.lo;
  const double width = std::sqrt(2 * areas / count), height = ways / count * span;
  slabs_ = static_cast<uint32_t>(std::clamp(std::ceil(height / width), 1.0, most_slabs));
  std::vector<Box> boxes;
  for (const Prism& prism : all_)
    for (uint32_t slab = 0; slab < slabs_; ++slab) {
      const Box box = prism.box({heights_.lo + span * slab / slabs_, heights_.lo + span * (slab + 1) / slabs_});
      mean_size_ += length(box.size()) / (count * slabs_);
      boxes.push_back(box.expanded(1e-9 * length(box.size())));
    }
  tree_ = BoxTree(boxes);
}

}  // namespace ombre::importing
