#include "import/fields/beam_shape.h"

#include <algorithm>
#include <cmath>

namespace ombre::importing {
namespace {

const Interval nothing{1, 0};
// Rounding error of a discriminant, as a share of the squares in it; a line that touches a surface may seem to miss it
// by this much.
constexpr double touching = 1e-12;

double distance_to_segment(double x, double y, double x1, double y1) {
  const double t = std::clamp((x * x1 + y * y1) / (x1 * x1 + y1 * y1), 0.0, 1.0);
  return std::hypot(x - t * x1, y - t * y1);
}

// Returns the zeros of a*t^2 + 2*b*t + c in ascending order.
Interval roots(double a, double b, double c) {
  const double squares = std::max(b * b, std::abs(a * c)), discriminant = b * b - a * c;
  if (a == 0) return b == 0 ? nothing : Interval{-0.5 * c / b, -0.5 * c / b};
  if (discriminant < -touching * squares) return nothing;
  const double root = std::sqrt(std::max(discriminant, 0.0)), q = -(b + std::copysign(root, b));
  const double one = q / a, other = q == 0 ? one : c / q;
  return {std::min(one, other), std::max(one, other)};
}

Interval meet(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

// Returns the interval of t in which value + t * change lies between 0 and `most`.
Interval slab(double value, double change, double most) {
  if (change == 0) return value >= 0 && value <= most ? Interval{-Box::inf, Box::inf} : nothing;
  const double at_zero = -value / change, at_most = (most - value) / change;
  return {std::min(at_zero, at_most), std::max(at_zero, at_most)};
}

}  // namespace

BeamShape::BeamShape(Vec3 start, Vec3 end, std::array<double, 2> radii, std::array<Cap, 2> caps)
    : ends_{start, end}, length_(length(end - start)), radii_(radii), caps_(caps) {
  axis_ = (1 / length_) * (end - start);
  slope_ = (radii[1] - radii[0]) / length_;
  slant_cosine_ = 1 / std::hypot(1.0, slope_);
  // At the end of a cylinder, half a ball is equivalent to a whole one.
  for (Cap& cap : caps_)
    if (cap == Cap::hemisphere && slope_ == 0) cap = Cap::sphere;
}

BeamShape BeamShape::ball(Vec3 centre, double radius) {
  BeamShape ball;
  ball.ends_ = {centre, centre};
  ball.radii_ = {radius, radius};
  ball.caps_ = {Cap::sphere, Cap::butt};
  return ball;
}

BeamShape::Place BeamShape::place(Vec3 p) const {
  const Vec3 from = p - ends_[0];
  const double along = dot(from, axis_);
  return {along, ombre::length(from - along * axis_)};
}

bool BeamShape::has(Piece piece) const { return piece == frustum ? !is_ball() : caps_[piece - 1] != Cap::butt; }

bool BeamShape::is_missed_by(Vec3 origin, Vec3 step) const {
  constexpr double sure = 1 + 1e-9;
  const Vec3 across = cross(axis_, step);
  const double way = dot(origin - ends_[0], across), radius = greatest_radius();
  return way * way > sure * radius * radius * dot(across, across) && dot(across, across) > 1e-12 * dot(step, step);
}

bool BeamShape::holds(Piece piece, Vec3 p) const {
  if (piece == frustum) {
    const Place at = place(p);
    return at.along >= 0 && at.along <= length_ && at.across <= radius_at(at.along);
  }
  const int i = piece - 1;
  const Vec3 from = p - ends_[i];
  if (!(dot(from, from) <= radii_[i] * radii_[i])) return false;
  return caps_[i] == Cap::sphere || beyond(i, dot(p - ends_[0], axis_)) >= 0;
}

double BeamShape::distance(Vec3 p) const {
  if (is_ball()) return ombre::length(p - ends_[0]) - radii_[0];
  const Place at = place(p);
  double depth = Box::inf, away = frustum_distance(at);
  if (holds(frustum, p)) depth = depth_in_frustum(p, at);
  for (const int i : {0, 1}) {
    const auto cap = static_cast<Piece>(i + 1);
    if (!has(cap)) continue;
    if (holds(cap, p)) depth = std::min(depth, depth_in_cap(i, p, at));
    if (caps_[i] == Cap::sphere || beyond(i, at.along) >= 0)
      away = std::min(away, ombre::length(p - ends_[i]) - radii_[i]);
  }
  return std::min(depth, std::max(away, 0.0));
}

// Returns the distance from an outside point to the frustum, in the half plane of `along` and `across`.
double BeamShape::frustum_distance(Place at) const {
  const double first = std::hypot(at.along, std::max(0.0, at.across - radii_[0]));
  const double second = std::hypot(at.along - length_, std::max(0.0, at.across - radii_[1]));
  const double slant = distance_to_segment(at.along, at.across - radii_[0], length_, radii_[1] - radii_[0]);
  return std::min({first, second, slant});
}

// Beyond an end with a cap, a ball around p may extend into the cap.
double BeamShape::depth_in_frustum(Vec3 p, Place at) const {
  double depth = slant_distance(at);
  for (const int i : {0, 1}) {
    double end = beyond(i, at.along);
    if (caps_[i] != Cap::butt) end = std::min(end, ombre::length(p - ends_[i]) - radii_[i]);
    depth = std::max(depth, end);
  }
  return std::min(depth, 0.0);
}

// Half a ball continues into the frustum, which is narrower than the ball behind its thicker end.
double BeamShape::depth_in_cap(int i, Vec3 p, Place at) const {
  const double depth = ombre::length(p - ends_[i]) - radii_[i];
  if (caps_[i] == Cap::sphere) return depth;
  const double to_other_end = -(length_ + beyond(i, at.along));
  const bool is_thicker = radii_[i] > radii_[1 - i];
  return std::min(0.0, std::max({depth, to_other_end, is_thicker ? slant_distance(at) : -Box::inf}));
}

Interval BeamShape::chord(Piece piece, Vec3 origin, Vec3 step) const {
  // The origin moves near to the beam, so that squares keep their digits.
  const double middle = dot(0.5 * (ends_[0] + ends_[1]) - origin, step) / dot(step, step);
  const Vec3 near = origin + middle * step;
  const Interval found = piece == frustum ? frustum_chord(near, step) : ball_chord(piece - 1, near, step);
  return {found.lo + middle, found.hi + middle};
}

Interval BeamShape::ball_chord(int i, Vec3 origin, Vec3 step) const {
  const Vec3 from = origin - ends_[i];
  const Interval ball = roots(dot(step, step), dot(from, step), dot(from, from) - radii_[i] * radii_[i]);
  if (caps_[i] == Cap::sphere || ball.lo > ball.hi) return ball;
  const double sign = i == 0 ? -1 : 1;
  return meet(ball, slab(sign * dot(from, axis_), sign * dot(step, axis_), Box::inf));
}

Interval BeamShape::frustum_chord(Vec3 origin, Vec3 step) const {
  const Vec3 from = origin - ends_[0];
  const double along = dot(from, axis_), change = dot(step, axis_);
  const Interval within = slab(along, change, length_);
  if (within.lo > within.hi) return nothing;
  const Vec3 across = from - along * axis_, turn = step - change * axis_;
  const double radius = radius_at(along), growth = slope_ * change;
  const double a = dot(turn, turn) - growth * growth, b = dot(across, turn) - radius * growth,
               c = dot(across, across) - radius * radius;
  const Interval zeros = roots(a, b, c);
  // The line does not change between inside and outside between two zeros.
  std::array<double, 4> ends{within.lo, within.lo, within.hi, within.hi};
  if (zeros.lo <= zeros.hi) {
    ends[1] = std::clamp(zeros.lo, within.lo, within.hi);
    ends[2] = std::clamp(zeros.hi, within.lo, within.hi);
  }
  Interval found = nothing;
  for (size_t n = 0; n + 1 < ends.size(); ++n) {
    const double t = 0.5 * (ends[n] + ends[n + 1]);
    const double scale = dot(across, across) + radius * radius;
    if (!std::isfinite(t) || !((a * t + 2 * b) * t + c <= touching * scale)) continue;
    found = found.lo > found.hi ? Interval{ends[n], ends[n + 1]} : Interval{found.lo, ends[n + 1]};
  }
  return found;
}

}  // namespace ombre::importing
