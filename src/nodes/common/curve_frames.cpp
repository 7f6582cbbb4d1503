#include "nodes/common/curve_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ombre::nodes {
namespace {

constexpr size_t nodes_per_section = 16;
constexpr double rounding_mm = 1e-9;

// Returns the second derivatives at the knots of the natural cubic spline (Thomas' algorithm).
std::vector<Vec3> second_derivatives(const std::vector<Vec3>& points, const std::vector<double>& widths) {
  const size_t last = points.size() - 1;
  std::vector<Vec3> second(points.size()), right(points.size());
  std::vector<double> above(points.size());
  for (size_t n = 1; n < last; ++n) {
    const double before = widths[n - 1], after = widths[n];
    const Vec3 change = (6 / after) * (points[n + 1] - points[n]) - (6 / before) * (points[n] - points[n - 1]);
    const double diagonal = 2 * (before + after) - before * above[n - 1];
    above[n] = after / diagonal;
    right[n] = (1 / diagonal) * (change - before * right[n - 1]);
  }
  for (size_t n = last; n-- > 1;) second[n] = right[n] - above[n] * second[n + 1];
  return second;
}

// Solves a symmetric tridiagonal system whose equation number n has the coefficients beside[n - 1], diagonal[n] and
// beside[n] (Thomas' algorithm).
template <class Value>
std::vector<Value> solved(const std::vector<double>& diagonal, const std::vector<double>& beside,
                          std::vector<Value> right) {
  const size_t count = diagonal.size();
  std::vector<double> above(count, 0);
  for (size_t n = 0; n < count; ++n) {
    const double below = n > 0 ? beside[n - 1] : 0;
    const double left = 1 / (diagonal[n] - (n > 0 ? below * above[n - 1] : 0));
    if (n + 1 < count) above[n] = left * beside[n];
    right[n] = left * (n > 0 ? right[n] - below * right[n - 1] : right[n]);
  }
  for (size_t n = count - 1; n-- > 0;) right[n] = right[n] - above[n] * right[n + 1];
  return right;
}

// Returns the second derivatives at the knots of the periodic cubic spline through points, of which the last is the
// first. The system is tridiagonal but for two corners (Sherman and Morrison's formula).
std::vector<Vec3> periodic_second_derivatives(const std::vector<Vec3>& points, const std::vector<double>& widths) {
  const size_t count = widths.size();
  const double corner = widths[count - 1];
  std::vector<double> diagonal, corners(count, 0);
  std::vector<Vec3> right;
  for (size_t n = 0; n < count; ++n) {
    const double before = widths[(n + count - 1) % count], after = widths[n];
    diagonal.push_back(2 * (before + after));
    right.push_back((6 / after) * (points[n + 1] - points[n]) -
                    (6 / before) * (points[n] - points[(n + count - 1) % count]));
  }
  const double moved = -diagonal[0];
  diagonal[0] -= moved;
  diagonal[count - 1] -= corner * corner / moved;
  corners[0] = moved;
  corners[count - 1] = corner;
  std::vector<Vec3> second = solved(diagonal, widths, right);
  const std::vector<double> by = solved(diagonal, widths, corners);
  const Vec3 share =
      (1 / (1 + by[0] + corner / moved * by[count - 1])) * (second[0] + (corner / moved) * second[count - 1]);
  for (size_t n = 0; n < count; ++n) second[n] = second[n] - by[n] * share;
  second.push_back(second.front());
  return second;
}

// Turns a vector that is perpendicular to the axis about it.
Vec3 turned(Vec3 v, Vec3 axis, double angle) { return std::cos(angle) * v + std::sin(angle) * cross(axis, v); }

}  // namespace

CurveFrames::CurveFrames(std::vector<Vec3> points, const CurveRule& rule) : rule_(rule) {
  make_sections(points);
  make_nodes();
  if (rule.ends == CurveRule::Ends::closed) close_frames();
  find_tightest();
  points.push_back(rule.toward);
  content_ = hash_bytes("curve frames " + std::to_string(static_cast<int>(rule.ends)) + ' ' +
                        std::to_string(static_cast<int>(rule.frame)) + ' ' +
                        std::string(reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Vec3)));
}

void CurveFrames::make_sections(std::vector<Vec3> points) {
  const bool is_closed = rule_.ends == CurveRule::Ends::closed;
  if (is_closed) points.push_back(points.front());
  std::vector<double> widths;
  for (size_t n = 1; n < points.size(); ++n) widths.push_back(ombre::length(points[n] - points[n - 1]));
  const std::vector<Vec3> second =
      is_closed ? periodic_second_derivatives(points, widths) : second_derivatives(points, widths);
  double begin = 0;
  for (size_t n = 0; n < widths.size(); ++n) {
    const double h = widths[n];
    const Vec3 slope = (1 / h) * (points[n + 1] - points[n]) - (h / 6) * (2 * second[n] + second[n + 1]);
    sections_.push_back({begin, h, {points[n], slope, 0.5 * second[n], (1 / (6 * h)) * (second[n + 1] - second[n])}});
    begin += h;
  }
}

void CurveFrames::make_nodes() {
  const Vec3 toward = rule_.toward;
  for (size_t n = 0; n < sections_.size(); ++n)
    for (size_t part = n == 0 ? 0 : 1; part <= nodes_per_section; ++part) {
      const Section& section = sections_[n];
      Node node;
      node.section = n;
      node.parameter = section.begin + section.width * static_cast<double>(part) / nodes_per_section;
      const Moving moving = at(node.parameter, n);
      node.at = moving.at;
      node.tangent = moving.tangent();
      if (nodes_.empty()) {
        Vec3 up = toward - dot(toward, node.tangent) * node.tangent;
        if (!(ombre::length(up) > 1e-9 * ombre::length(toward)))
          up = std::abs(node.tangent.x) < 0.9 ? Vec3{1, 0, 0} - node.tangent.x * node.tangent
                                              : Vec3{0, 1, 0} - node.tangent.y * node.tangent;
        node.normal = cross((1 / ombre::length(up)) * up, node.tangent);
      } else {
        node.normal = moved_normal(nodes_.back(), node.at, node.tangent);
        node.along = nodes_.back().along + arc(nodes_.back().parameter, node.parameter, n);
      }
      nodes_.push_back(node);
    }
}

// Spreads the angle that is left between the first and the last frame along the curve.
void CurveFrames::close_frames() {
  const Vec3 tangent = nodes_.back().tangent, from = nodes_.back().normal, to = nodes_.front().normal;
  turn_ = std::atan2(dot(cross(from, to), tangent), dot(from, to)) / length();
  for (Node& node : nodes_) node.normal = turned(node.normal, node.tangent, turn_ * node.along);
}

CurveFrames::Moving CurveFrames::at(double parameter, size_t section) const {
  const auto& [begin, width, c] = sections_[section];
  const double t = parameter - begin;
  return {c[0] + t * (c[1] + t * (c[2] + t * c[3])), c[1] + t * (2 * c[2] + (3 * t) * c[3]), 2 * c[2] + (6 * t) * c[3]};
}

Vec3 CurveFrames::Moving::curvature() const {
  const double squared = dot(speed, speed);
  return (1 / squared) * (bend - (dot(bend, speed) / squared) * speed);
}

// Gauss-Legendre quadrature with five points.
double CurveFrames::arc(double from, double to, size_t section) const {
  constexpr std::array<std::array<double, 2>, 5> rule{{{0, 128.0 / 225},
                                                       {0.5384693101056831, 0.4786286704993665},
                                                       {-0.5384693101056831, 0.4786286704993665},
                                                       {0.9061798459386640, 0.2369268850561891},
                                                       {-0.9061798459386640, 0.2369268850561891}}};
  const double half = (to - from) / 2, middle = (to + from) / 2;
  double sum = 0;
  for (const auto& [place, weight] : rule) sum += weight * ombre::length(at(middle + half * place, section).speed);
  return sum * half;
}

// Reflects the frame twice, so that it fits the other point and tangent.
Vec3 CurveFrames::moved_normal(const Node& from, Vec3 to, Vec3 tangent) const {
  const auto reflected = [](Vec3 v, Vec3 across) {
    const double squared = dot(across, across);
    return squared > 0 ? v - (2 * dot(across, v) / squared) * across : v;
  };
  const Vec3 way = to - from.at;
  if (!(dot(way, way) > 0)) return from.normal;
  const Vec3 half_way = reflected(from.normal, way);
  return reflected(half_way, tangent - reflected(from.tangent, way));
}

void CurveFrames::find_tightest() {
  for (const Node& node : nodes_) {
    const double radius = 1 / ombre::length(at(node.parameter, node.section).curvature());
    if (!(radius < least_radius_)) continue;
    least_radius_ = radius;
    tightest_ = node.at;
  }
}

std::optional<Vec3> CurveFrames::near_itself(double reach) const {
  const bool is_closed = rule_.ends == CurveRule::Ends::closed;
  for (size_t i = 0; i < nodes_.size(); ++i)
    for (size_t j = i + 1; j < nodes_.size(); ++j) {
      const double onward = nodes_[j].along - nodes_[i].along;
      const double between = is_closed ? std::min(onward, length() - onward) : onward;
      const bool are_apart = between > std::numbers::pi * reach;
      if (are_apart && ombre::length(nodes_[j].at - nodes_[i].at) < 2 * reach) return nodes_[i].at;
    }
  return std::nullopt;
}

Box CurveFrames::box() const {
  Box all;
  double gap = 0;
  for (size_t n = 0; n < nodes_.size(); ++n) {
    all = hull(all, Box{nodes_[n].at, nodes_[n].at});
    if (n > 0) gap = std::max(gap, nodes_[n].along - nodes_[n - 1].along);
  }
  // An arc between two nodes is at most half a chord away from the chord while it turns by less than a quarter.
  return all.expanded(gap / 2);
}

int CurveFrames::channel(std::string_view channel_name) const {
  constexpr std::array<std::string_view, channel_count> names{"along",    "first",     "second",    "stretch",
                                                              "distance", "tangent_x", "tangent_y", "tangent_z",
                                                              "normal_x", "normal_y",  "normal_z"};
  const auto found = std::ranges::find(names, channel_name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

// Finds where the way to p is perpendicular to the curve, between the neighbours of a node.
double CurveFrames::nearest_parameter(Vec3 p, size_t node) const {
  constexpr int most_steps = 60;
  double lo = nodes_[node == 0 ? 0 : node - 1].parameter, hi = nodes_[std::min(node + 1, nodes_.size() - 1)].parameter;
  double t = nodes_[node].parameter;
  for (int step = 0; step < most_steps; ++step) {
    const size_t section =
        nodes_[node].parameter < t && node + 1 < nodes_.size() ? nodes_[node + 1].section : nodes_[node].section;
    const Moving moving = at(t, section);
    const Vec3 way = p - moving.at;
    const double ahead = dot(way, moving.speed), slope = dot(way, moving.bend) - dot(moving.speed, moving.speed);
    (ahead > 0 ? lo : hi) = t;
    double next = slope < 0 ? t - ahead / slope : 0.5 * (lo + hi);
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::abs(next - t) <= 1e-12 * nodes_.back().parameter) return next;
    t = next;
  }
  return t;
}

CurveFrames::Place CurveFrames::place_beyond(Vec3 p, const Node& end) const {
  const Vec3 way = p - end.at;
  const double ahead = dot(way, end.tangent), a = dot(way, end.normal), b = dot(way, cross(end.tangent, end.normal));
  return framed(end.along + ahead, way, end.tangent, end.normal, 1, std::sqrt(a * a + b * b));
}

CurveFrames::Place CurveFrames::framed(double s, Vec3 way, Vec3 tangent, Vec3 normal, double stretched, double away) {
  const Vec3 up = cross(tangent, normal);
  return {s, dot(way, normal), dot(way, up), stretched, away, tangent.x, tangent.y, tangent.z, up.x, up.y, up.z};
}

CurveFrames::Place CurveFrames::place(Vec3 p) const {
  size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t n = 0; n < nodes_.size(); ++n) {
    const Vec3 way = p - nodes_[n].at;
    const double squared = dot(way, way);
    if (squared >= least) continue;
    least = squared;
    nearest = n;
  }
  Place found = place_near(p, nearest);
  if (rule_.ends == CurveRule::Ends::closed && nearest == 0) {
    const Place other = place_near(p, nodes_.size() - 1);
    return other[distance] < found[distance] ? other : found;
  }
  if (rule_.ends != CurveRule::Ends::straight) return found;
  const bool is_before = dot(p - nodes_.front().at, nodes_.front().tangent) < 0;
  const bool is_after = dot(p - nodes_.back().at, nodes_.back().tangent) > 0;
  for (const auto& [is_beyond, end] : {std::pair{is_before, &nodes_.front()}, {is_after, &nodes_.back()}}) {
    if (!is_beyond) continue;
    const Place beyond = place_beyond(p, *end);
    if (beyond[distance] < found[distance]) found = beyond;
  }
  return found;
}

CurveFrames::Place CurveFrames::place_near(Vec3 p, size_t nearest) const {
  constexpr double straight = 1e-9;  // least curvature with a normal of Frenet, per mm
  const double t = nearest_parameter(p, nearest);
  const size_t from = t < nodes_[nearest].parameter && nearest > 0 ? nearest - 1 : nearest;
  const size_t section = from + 1 < nodes_.size() ? nodes_[from + 1].section : nodes_[from].section;
  const Moving moving = at(t, section);
  const Vec3 way = p - moving.at, tangent = moving.tangent(), curvature = moving.curvature();
  const double onward = arc(nodes_[from].parameter, t, section);
  Vec3 normal = moved_normal(nodes_[from], moving.at, tangent);
  if (turn_ != 0) normal = turned(normal, tangent, turn_ * onward);
  if (rule_.frame == CurveRule::Frame::frenet && ombre::length(curvature) > straight)
    normal = cross((1 / ombre::length(curvature)) * curvature, tangent);
  return framed(nodes_[from].along + onward, way, tangent, normal, 1 - dot(way, curvature), ombre::length(way));
}

double CurveFrames::sample(int channel, Vec3 p) const { return place(p)[static_cast<size_t>(channel)]; }

void CurveFrames::sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                                  std::span<double* const> values) const {
  for (size_t n = 0; n < points.size(); ++n) {
    const Place found = place(points[n]);
    for (size_t c = 0; c < channels.size(); ++c) values[c][n] = found[static_cast<size_t>(channels[c])];
  }
}

Interval CurveFrames::range(int channel, const Box& box) const {
  if (!box.is_bounded()) return Interval::everything();
  constexpr double more = 1.05;  // allows for curvature between nodes, and for the rounding of frames
  const double radius = ombre::length(box.size()) / 2 * more + rounding_mm;
  const Place middle = place(box.center());
  const double farthest = middle[distance] + radius;
  if (channel == distance) return {std::max(0.0, middle[distance] - radius), farthest};
  if (channel >= tangent_x) return {-1 - rounding_mm, 1 + rounding_mm};
  const double bend = farthest / least_radius_ * more;
  if (farthest >= reach_ || bend >= 1) return Interval::everything();
  if (channel == stretch) return {1 - bend, 1 + bend};
  if (channel != along && rule_.frame == CurveRule::Frame::frenet) return {-farthest, farthest};
  const double turning = channel == along ? 0 : std::abs(turn_) * farthest;
  const double value = middle[static_cast<size_t>(channel)];
  const double by = channel == along ? radius / (1 - bend) : radius * (1 + turning / (1 - bend));
  const bool passes_start =
      channel == along && rule_.ends == CurveRule::Ends::closed && (value < by || value + by > length());
  return passes_start ? Interval(-rounding_mm, length() + rounding_mm) : Interval(value - by, value + by);
}

std::shared_ptr<CurveFrames> smooth_curve(const design::Points& points, const CurveRule& rule,
                                          const design::Reader& reader) {
  std::vector<Vec3> way;
  for (const Vec3& point : points.at)
    if (way.empty() || !(point == way.back())) way.push_back(point);
  const bool is_closed = rule.ends == CurveRule::Ends::closed;
  if (is_closed && way.size() > 1 && way.front() == way.back()) way.pop_back();
  constexpr size_t most_points = 1000;
  const size_t least_points = is_closed ? 3 : 2;
  if (way.size() >= least_points && way.size() <= most_points)
    return std::make_shared<CurveFrames>(std::move(way), rule);
  reader.refuse(std::string(reader.node) + " needs " + std::to_string(least_points) + " to 1000 different points",
                "write for example " + spelled::parameter("points", "[(0, 0, 0), (10, 0, 0), (15, 8, 0)]"));
  return nullptr;
}

}  // namespace ombre::nodes
