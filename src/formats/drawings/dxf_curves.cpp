#include "formats/drawings/dxf_curves.h"

#include <algorithm>
#include <cmath>

#include "formats/drawings/arcs.h"

namespace ombre::formats {
namespace {

constexpr int highest_degree = 25;

// Returns how many chords approximate one of a number of pieces of a curve.
int chords_of_piece(size_t pieces) {
  return static_cast<int>(std::clamp<size_t>(200 / std::max<size_t>(1, pieces), 8, 64));
}

struct Weighted {
  Vec2 point;  // times the weight
  double weight = 1;
};

Weighted blend(const Weighted& a, const Weighted& b, double share) {
  return {(1 - share) * a.point + share * b.point, (1 - share) * a.weight + share * b.weight};
}

// Evaluates a rational B-spline by the algorithm of de Boor; `span` is the interval of knots that holds t.
Vec2 point_at(const DxfSpline& spline, size_t span, double t) {
  const auto degree = static_cast<size_t>(spline.degree);
  std::vector<Weighted> d(degree + 1);
  for (size_t n = 0; n <= degree; ++n) {
    const size_t at = span - degree + n;
    const double weight = at < spline.weights.size() ? spline.weights[at] : 1;
    d[n] = {weight * spline.controls[at], weight};
  }
  for (size_t round = 1; round <= degree; ++round)
    for (size_t n = degree; n >= round; --n) {
      const double from = spline.parameters[span - degree + n], to = spline.parameters[span + 1 + n - round];
      d[n] = blend(d[n - 1], d[n], to > from ? (t - from) / (to - from) : 0);
    }
  return (1 / d[degree].weight) * d[degree].point;
}

bool is_valid(const DxfSpline& spline) {
  const size_t count = spline.controls.size();
  return spline.degree >= 1 && spline.degree <= highest_degree && count > static_cast<size_t>(spline.degree) &&
         spline.parameters.size() >= count + static_cast<size_t>(spline.degree) + 1 &&
         std::ranges::is_sorted(spline.parameters) &&
         std::ranges::all_of(spline.weights, [](double weight) { return weight > 0; });
}

Ring curve_of_controls(const DxfSpline& spline) {
  if (!is_valid(spline)) return {};
  const auto degree = static_cast<size_t>(spline.degree);
  size_t pieces = 0;
  for (size_t n = degree; n < spline.controls.size(); ++n) pieces += spline.parameters[n + 1] > spline.parameters[n];
  const int chords = chords_of_piece(pieces);
  Ring ring;
  for (size_t span = degree; span < spline.controls.size(); ++span) {
    const double from = spline.parameters[span], to = spline.parameters[span + 1];
    if (!(to > from)) continue;
    for (int n = ring.empty() ? 0 : 1; n <= chords; ++n)
      ring.push_back(point_at(spline, span, from + (to - from) * n / chords));
  }
  return ring;
}

// Returns the second derivatives of the cubic spline through points at places t; it is natural at an end without a
// direction.
std::vector<Vec2> bends_of(const std::vector<Vec2>& p, const std::vector<double>& t, const std::optional<Vec2>& first,
                           const std::optional<Vec2>& last) {
  const size_t n = p.size();
  std::vector<double> lower(n, 0), diagonal(n, 1), upper(n, 0);
  std::vector<Vec2> right(n);
  const auto slope = [&](size_t k) { return (1 / (t[k + 1] - t[k])) * (p[k + 1] - p[k]); };
  for (size_t k = 1; k + 1 < n; ++k) {
    lower[k] = t[k] - t[k - 1];
    upper[k] = t[k + 1] - t[k];
    diagonal[k] = 2 * (t[k + 1] - t[k - 1]);
    right[k] = 6 * (slope(k) - slope(k - 1));
  }
  if (first) {
    upper[0] = t[1] - t[0];
    diagonal[0] = 2 * upper[0];
    right[0] = 6 * (slope(0) - *first);
  }
  if (last) {
    lower[n - 1] = t[n - 1] - t[n - 2];
    diagonal[n - 1] = 2 * lower[n - 1];
    right[n - 1] = 6 * (*last - slope(n - 2));
  }
  // The system is tridiagonal with a dominant diagonal.
  for (size_t k = 1; k < n; ++k) {
    const double factor = lower[k] / diagonal[k - 1];
    diagonal[k] -= factor * upper[k - 1];
    right[k] = right[k] - factor * right[k - 1];
  }
  for (size_t k = n; k-- > 0;) {
    if (k + 1 < n) right[k] = right[k] - upper[k] * right[k + 1];
    right[k] = (1 / diagonal[k]) * right[k];
  }
  return right;
}

std::optional<Vec2> unit(const std::optional<Vec2>& way) {
  if (!way || !(length(*way) > 0)) return std::nullopt;
  return (1 / length(*way)) * *way;
}

Ring curve_through(const DxfSpline& spline) {
  std::vector<Vec2> p;
  for (const Vec2& point : spline.fits)
    if (p.empty() || length(point - p.back()) > 0) p.push_back(point);
  if (p.size() < 2) return {};
  // A closed curve is smooth where it begins: points beyond its ends act on it, and their effect fades fourfold with
  // each.
  size_t beyond = 0;
  if (spline.is_closed && p.size() > 2) {
    constexpr size_t enough = 16;
    if (p.front() == p.back()) p.pop_back();
    const std::vector<Vec2> round = p;
    beyond = enough;
    p.clear();
    const size_t count = round.size();
    for (size_t n = 0; n <= count + 2 * beyond; ++n) p.push_back(round[(n + beyond * (count - 1)) % count]);
  }
  std::vector<double> t{0};
  for (size_t n = 1; n < p.size(); ++n) t.push_back(t.back() + length(p[n] - p[n - 1]));
  const std::vector<Vec2> bends = bends_of(p, t, unit(spline.first_way), unit(spline.last_way));
  const int chords = chords_of_piece(p.size() - 1 - 2 * beyond);
  Ring ring{p[beyond]};
  for (size_t k = beyond; k + 1 + beyond < p.size(); ++k) {
    const double h = t[k + 1] - t[k];
    for (int n = 1; n <= chords; ++n) {
      const double b = static_cast<double>(n) / chords, a = 1 - b;
      ring.push_back(a * p[k] + b * p[k + 1] +
                     (h * h / 6) * ((a * a * a - a) * bends[k] + (b * b * b - b) * bends[k + 1]));
    }
  }
  if (beyond > 0) ring.back() = ring.front();
  return ring;
}

}  // namespace

void append_bulge(Vec2 to, double bulge, const ChordsOfRadius& chords, Ring& ring) {
  const Vec2 from = ring.back();
  if (bulge == 0 || from == to) {
    ring.push_back(to);
    return;
  }
  const double turn = 4 * math::atan(bulge);
  const Vec2 chord = to - from, middle = 0.5 * (from + to);
  // distance of the center from the chord, in lengths of the chord
  const double rise = (1 - bulge * bulge) / (4 * bulge);
  const Vec2 center = middle + rise * Vec2{-chord.y, chord.x};
  const Vec2 first = from - center;
  Ring arc;
  append_arc({center, first, {-first.y, first.x}, 0, turn}, chords(length(first)), arc);
  ring.insert(ring.end(), arc.begin() + 1, arc.end() - 1);
  ring.push_back(to);
}

Ring curve_of(const DxfSpline& spline) {
  return spline.controls.empty() ? curve_through(spline) : curve_of_controls(spline);
}

}  // namespace ombre::formats
