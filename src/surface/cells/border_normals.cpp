#include "surface/cells/border_normals.h"

#include <cmath>
#include <optional>

namespace ombre::surface {
namespace {

// Steps as fractions of the length of a cell's edge.
constexpr double gradient_step = 1e-4;
constexpr double slope_step = 0.03;
constexpr int slope_rounds = 20;
// A value counts as discontinuous at its zero if its slope there exceeds the edge's average slope by this factor.
constexpr double jump_ratio = 1e3;

Vec3 unit(int axis) {
  Vec3 v;
  v[axis] = 1;
  return v;
}

Vec3 normalized(Vec3 v) { return (1 / length(v)) * v; }

std::vector<Vec3> gradients(std::span<const EdgeSearch> searches, const Vec3& cell_mm, PointEvaluator& evaluator) {
  std::vector<Vec3> points;
  for (const EdgeSearch& s : searches)
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {1.0, -1.0})
        points.push_back(s.point(s.t) + side * gradient_step * cell_mm[axis] * unit(axis));
  evaluator.ask(points);
  std::vector<Vec3> found(searches.size());
  for (size_t n = 0; n < searches.size(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const size_t at = 6 * n + 2 * static_cast<size_t>(axis);
      const auto f = [&](size_t answer) { return evaluator.between(searches[n].from, searches[n].to, answer); };
      found[n][axis] = (f(at) - f(at + 1)) / (2 * gradient_step * cell_mm[axis]);
    }
  return found;
}

bool is_usable(const EdgeSearch& s, Vec3 gradient) {
  const double steepness = length(gradient);
  return s.by_value && std::isfinite(steepness) && steepness > 0 && steepness < jump_ratio * s.rise / length(s.along);
}

// A copy of an edge, shifted sideways and cut down to the stretch around its crossing.
struct ShiftedEdge {
  const EdgeSearch* edge;
  Vec3 shift;
  double lo, hi;
  double middle() const { return 0.5 * (lo + hi); }
  Vec3 point() const { return edge->point(middle()) + shift; }
};

void find_borders(std::vector<ShiftedEdge>& shifted, PointEvaluator& evaluator) {
  std::vector<Vec3> points(shifted.size());
  for (int round = 0; round < slope_rounds; ++round) {
    for (size_t n = 0; n < shifted.size(); ++n) points[n] = shifted[n].point();
    evaluator.ask(points);
    for (size_t n = 0; n < shifted.size(); ++n)
      (evaluator.label(n) == shifted[n].edge->from ? shifted[n].lo : shifted[n].hi) = shifted[n].middle();
  }
}

int axis_of(const EdgeSearch& s) { return s.along.x != 0 ? 0 : s.along.y != 0 ? 1 : 2; }

// Returns normals from where the border crosses four shifted copies of each edge.
std::vector<Vec3> slopes(const std::vector<const EdgeSearch*>& searches, const Vec3& cell_mm,
                         PointEvaluator& evaluator) {
  std::vector<ShiftedEdge> shifted;
  for (const EdgeSearch* s : searches)
    for (int other = 1; other < 3; ++other)
      for (const double side : {1.0, -1.0}) {
        const int across = (axis_of(*s) + other) % 3;
        shifted.push_back(
            {s, side * slope_step * cell_mm[across] * unit(across), s->t - normals_reach, s->t + normals_reach});
      }
  find_borders(shifted, evaluator);
  std::vector<Vec3> found;
  for (size_t n = 0; n < searches.size(); ++n) {
    const int axis = axis_of(*searches[n]);
    Vec3 normal = unit(axis);
    for (int other = 1; other < 3; ++other) {
      const ShiftedEdge* pair = &shifted[4 * n + 2 * static_cast<size_t>(other - 1)];
      const int across = (axis + other) % 3;
      normal[across] = -(pair[0].lo - pair[1].lo) * cell_mm[axis] / (2 * slope_step * cell_mm[across]);
    }
    found.push_back(normalized(normal));
  }
  return found;
}

}  // namespace

std::vector<Vec3> border_normals(std::span<const EdgeSearch> searches, const Vec3& cell_mm, PointEvaluator& evaluator) {
  std::vector<Vec3> normals = gradients(searches, cell_mm, evaluator);
  std::vector<size_t> without;
  std::vector<const EdgeSearch*> sloping;
  for (size_t n = 0; n < searches.size(); ++n) {
    if (is_usable(searches[n], normals[n])) {
      normals[n] = normalized(normals[n]);
      continue;
    }
    without.push_back(n);
    sloping.push_back(&searches[n]);
  }
  if (sloping.empty()) return normals;
  const std::vector<Vec3> found = slopes(sloping, cell_mm, evaluator);
  for (size_t m = 0; m < without.size(); ++m) normals[without[m]] = found[m];
  return normals;
}

}  // namespace ombre::surface
