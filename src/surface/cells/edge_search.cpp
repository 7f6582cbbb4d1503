#include "surface/cells/edge_search.h"

#include <cmath>

namespace ombre::surface {
namespace {

constexpr double exact_enough = 1e-8;  // as a fraction of the edge's length
constexpr int most_search_rounds = 40;
constexpr double beside = 1e-4;  // distance from an end, as a fraction of the edge

// Settles searches whose value is 0 at an end: the border is at that end, unless the value stays 0 for a stretch; then
// labels decide.
void settle_ends(std::span<EdgeSearch> searches, PointEvaluator& evaluator) {
  std::vector<EdgeSearch*> settled;
  std::vector<Vec3> points;
  for (EdgeSearch& s : searches) {
    if (!s.by_value || (s.f_lo != 0 && s.f_hi != 0)) continue;
    s.t = s.f_lo == 0 ? 0 : 1;
    settled.push_back(&s);
    points.push_back(s.point(s.t == 0 ? beside : 1 - beside));
  }
  if (settled.empty()) return;
  evaluator.ask(points);
  for (size_t n = 0; n < settled.size(); ++n) {
    EdgeSearch& s = *settled[n];
    const double f = evaluator.between(s.from, s.to, n);
    s.is_done = std::isfinite(f) && f != 0;
    s.by_value = s.is_done;
  }
}

void bracket(std::span<EdgeSearch> searches, PointEvaluator& evaluator) {
  std::vector<Vec3> ends;
  for (const EdgeSearch& s : searches) {
    ends.push_back(s.point(0));
    ends.push_back(s.point(1));
  }
  evaluator.ask(ends);
  for (size_t n = 0; n < searches.size(); ++n) {
    EdgeSearch& s = searches[n];
    s.f_lo = evaluator.between(s.from, s.to, 2 * n);
    s.f_hi = evaluator.between(s.from, s.to, 2 * n + 1);
    s.is_between = evaluator.label(2 * n) == s.from && evaluator.label(2 * n + 1) == s.to;
    s.rise = s.f_hi - s.f_lo;
    s.by_value = s.f_lo <= 0 && s.f_hi >= 0 && s.rise > 0 && std::isfinite(s.rise);
  }
}

void choose(EdgeSearch& s) {
  const double before = s.t;
  s.t = s.by_value && s.f_lo < s.f_hi ? s.lo + (s.hi - s.lo) * s.f_lo / (s.f_lo - s.f_hi) : 0.5 * (s.lo + s.hi);
  s.is_done = s.hi - s.lo < exact_enough || (s.by_value && std::abs(s.t - before) < exact_enough);
}

void halve_from_now(EdgeSearch& s) {
  s.by_value = false;
  s.lo = 0;
  s.hi = 1;
}

void narrow_by_value(EdgeSearch& s, double f) {
  if (!std::isfinite(f)) return halve_from_now(s);
  const bool is_before = f <= 0;
  (is_before ? s.lo : s.hi) = s.t;
  (is_before ? s.f_lo : s.f_hi) = f;
  // Illinois variant: the value at an end that stays twice is halved.
  const int kept = is_before ? 1 : -1;
  if (s.last_kept == kept) (is_before ? s.f_hi : s.f_lo) *= 0.5;
  s.last_kept = kept;
}

}  // namespace

void search_edges(std::span<EdgeSearch> searches, PointEvaluator& evaluator) {
  bracket(searches, evaluator);
  settle_ends(searches, evaluator);
  std::vector<EdgeSearch*> active;
  std::vector<Vec3> points;
  for (int round = 0; round < most_search_rounds; ++round) {
    active.clear();
    points.clear();
    for (EdgeSearch& s : searches) {
      if (s.is_done) continue;
      choose(s);
      active.push_back(&s);
      points.push_back(s.point(s.t));
    }
    if (active.empty()) return;
    evaluator.ask(points);
    for (size_t n = 0; n < active.size(); ++n) {
      EdgeSearch& s = *active[n];
      if (s.by_value)
        narrow_by_value(s, evaluator.between(s.from, s.to, n));
      else
        (evaluator.label(n) == s.from ? s.lo : s.hi) = s.t;
    }
  }
}

}  // namespace ombre::surface
