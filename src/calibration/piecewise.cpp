#include "calibration/piecewise.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/math/math.h"

namespace ombre::calibration {
namespace {

using Function = std::function<double(double)>;
using Points = std::vector<std::pair<double, double>>;

constexpr int deepest = 40;         // halvings of a piece
constexpr int pieces_at_first = 8;  // of each piece between corners, so that no bend is missed

// A curve that is given by a parameter, such as the input of a calibration.
struct Curve {
  std::function<std::pair<double, double>(double)> point;
  double tolerance = 0;  // of the second number
};

// Adds points behind `from`, up to `to`, until lines between them are near enough to the curve.
void refine(const Curve& curve, double from, const std::pair<double, double>& at_from, double to,
            const std::pair<double, double>& at_to, int depth, Points& points) {
  const double middle = from + (to - from) / 2;
  const auto at_middle = curve.point(middle);
  const double share = (at_middle.first - at_from.first) / (at_to.first - at_from.first);
  const double on_line = at_from.second + share * (at_to.second - at_from.second);
  if (depth == deepest || !(std::abs(at_middle.second - on_line) > curve.tolerance)) {
    points.push_back(at_to);
    return;
  }
  refine(curve, from, at_from, middle, at_middle, depth + 1, points);
  refine(curve, middle, at_middle, to, at_to, depth + 1, points);
}

Points pieces(const Curve& curve, const std::vector<double>& corners) {
  Points points{curve.point(corners.front())};
  for (size_t n = 0; n + 1 < corners.size(); ++n) {
    double from = corners[n];
    for (int piece = 1; piece <= pieces_at_first; ++piece) {
      const double to = piece == pieces_at_first ? corners[n + 1]
                                                 : corners[n] + (corners[n + 1] - corners[n]) * piece / pieces_at_first;
      const auto at_from = points.back();
      refine(curve, from, at_from, to, curve.point(to), 0, points);
      from = to;
    }
  }
  return points;
}

// Removes points on the line between their neighbours.
Points simplified(const Points& points, double tolerance) {
  Points kept{points.front()};
  for (size_t n = 1; n + 1 < points.size(); ++n) {
    // A point may go if all that went since the last one that stayed lie on the line to the next.
    const auto& from = kept.back();
    const auto& to = points[n + 1];
    const auto is_on_line = [&](const std::pair<double, double>& p) {
      const double share = (p.first - from.first) / (to.first - from.first);
      return std::abs(from.second + share * (to.second - from.second) - p.second) <= tolerance;
    };
    size_t first = n;
    while (first > 0 && points[first - 1].first > from.first) --first;
    if (!std::all_of(points.begin() + static_cast<ptrdiff_t>(first), points.begin() + static_cast<ptrdiff_t>(n) + 1,
                     is_on_line))
      kept.push_back(points[n]);
  }
  kept.push_back(points.back());
  return kept;
}

Function value_of(const Calibration& calibration, size_t input, std::span<const double> at) {
  return [&calibration, input, others = std::vector<double>(at.begin(), at.end())](double choice) {
    std::vector<double> inputs = others;
    inputs[input] = choice;
    return calibration.value(inputs);
  };
}

bool is_logarithmic(Interpolant interpolant) {
  return interpolant == Interpolant::log_linear || interpolant == Interpolant::log_mixture;
}

// Returns ascending points, each once; tables have no others.
Points ascending(Points points) {
  if (points.front().first > points.back().first) std::ranges::reverse(points);
  points.erase(
      std::unique(points.begin(), points.end(), [](const auto& a, const auto& b) { return !(b.first > a.first); }),
      points.end());
  return points;
}

}  // namespace

std::vector<double> corners_of(const Calibration& calibration, size_t input, const Interval& choices) {
  std::vector<double> corners{choices.lo};
  if (has_points(calibration.interpolant))
    for (const double key : calibration.grid.axes()[input])
      if (key > choices.lo && key < choices.hi) corners.push_back(key);
  corners.push_back(choices.hi);
  return corners;
}

Piecewise inverse_curve(const Calibration& calibration, size_t input, std::span<const double> at) {
  const Interval choices = calibration.choices(input, at);
  const Function value = value_of(calibration, input, at);
  const bool of_logarithm = is_logarithmic(calibration.interpolant);
  const Curve curve{[&](double choice) {
                      const double reached = value(choice);
                      return std::pair(of_logarithm ? math::log(reached) : reached, choice);
                    },
                    piecewise_tolerance * (choices.hi - choices.lo)};
  const Points points = ascending(pieces(curve, corners_of(calibration, input, choices)));
  return {of_logarithm, simplified(points, curve.tolerance)};
}

Piecewise forward_curve(const Calibration& calibration, size_t input, std::span<const double> at) {
  const Interval choices = calibration.choices(input, at);
  const Function value = value_of(calibration, input, at);
  const std::vector<double> corners = corners_of(calibration, input, choices);
  double largest = 0;
  for (const double corner : corners) largest = std::max(largest, std::abs(value(corner)));
  const Curve curve{[&](double choice) { return std::pair(choice, value(choice)); }, piecewise_tolerance * largest};
  return {false, simplified(pieces(curve, corners), curve.tolerance)};
}

}  // namespace ombre::calibration
