#include "import/charts/shell.h"

#include <cmath>

#include "base/math/math.h"
#include "import/charts/shell_prisms.h"

namespace ombre::importing {
namespace {

// Volumes below this share of that on the surface count as none.
constexpr double least_volume = 1e-4;
constexpr int heights_tested = 5;

double tested_height(Interval heights, int n) {
  return heights.lo + (heights.hi - heights.lo) * n / (heights_tested - 1.0);
}

// Returns the least t in (0, most] at which a quadratic polynomial with a positive value at 0 is 0, or nothing.
std::optional<double> first_root(double c0, double c1, double c2, double most) {
  if (!(c0 > 0)) return 0.0;
  std::optional<double> first;
  const auto take = [&](double t) {
    if (t > 0 && t <= most && (!first || t < *first)) first = t;
  };
  const double inside = c1 * c1 - 4 * c2 * c0;
  if (inside < 0) return std::nullopt;
  const double q = -0.5 * (c1 + std::copysign(std::sqrt(inside), c1));
  if (c2 != 0) take(q / c2);
  if (q != 0) take(c0 / q);
  return first;
}

}  // namespace

std::optional<Fold> find_fold(const Shell& shell) {
  const Prisms prisms(shell);
  const Interval heights = prisms.heights();
  std::optional<Fold> found;
  for (size_t n = 0; n < prisms.count(); ++n)
    for (int corner = 0; corner < 3; ++corner) {
      const auto c = prisms[n].turns(corner);
      // On the surface a way may be almost along it, which counts as a fold, too.
      const Vec3 normal = prisms[n].normal(0), way = prisms[n].corner_way(corner);
      const double room = least_volume * length(normal) * length(way);
      for (const double sign : {1.0, -1.0}) {
        const double most = sign > 0 ? heights.hi : -heights.lo;
        if (!(most > 0)) continue;
        const auto root = first_root(c[0] - room, sign * c[1], c[2], most);
        if (!root || (found && *root >= std::abs(found->height))) continue;
        found = {shell.patch.points[shell.patch.triangles[n][static_cast<size_t>(corner)]], sign * *root};
      }
    }
  return found;
}

std::optional<Vec3> find_overlap(const Shell& shell) {
  constexpr double inner = 1e-5;  // shares of a place inside of a prism
  const Prisms prisms(shell);
  const double room = inner * (shell.heights.hi - shell.heights.lo);
  for (size_t n = 0; n < prisms.count(); ++n)
    for (int step = 0; step < heights_tested; ++step) {
      const double t = tested_height(shell.heights, step);
      for (const auto& [b, c] :
           {std::pair(1.0 / 3, 1.0 / 3), std::pair(0.01, 0.01), std::pair(0.98, 0.01), std::pair(0.01, 0.98)}) {
        const Vec3 p = prisms[n].point({b, c, t});
        bool is_shared = false;
        prisms.each_near(Box{p, p}, [&](uint32_t other) {
          PrismPlace place;
          if (other == n || !prisms[other].find(p, shell.heights, place)) return;
          is_shared |= place.least_share() > inner && place.height > shell.heights.lo + room &&
                       place.height < shell.heights.hi - room;
        });
        if (is_shared) return p;
      }
    }
  return std::nullopt;
}

namespace {

// Returns the squares of the least and greatest stretch of a map from a plane, whose derivatives by u and v these are.
std::array<double, 2> squared_stretches(Vec3 by_u, Vec3 by_v) {
  const double a = dot(by_u, by_u), b = dot(by_u, by_v), c = dot(by_v, by_v);
  const double middle = 0.5 * (a + c), spread = std::sqrt(0.25 * (a - c) * (a - c) + b * b);
  return {std::max(0.0, middle - spread), middle + spread};
}

}  // namespace

ShellReport report_of(const Shell& shell) {
  ShellReport report;
  report.volumes = report.stretches = {Box::inf, -Box::inf};
  const auto add = [](Interval& all, double value) { all = {std::min(all.lo, value), std::max(all.hi, value)}; };
  const Prisms prisms(shell);
  for (size_t n = 0; n < prisms.count(); ++n) {
    const Corners& corners = shell.patch.triangles[n];
    const Vec2 a = shell.patch.places[corners[0]], first = shell.patch.places[corners[1]] - a,
               second = shell.patch.places[corners[2]] - a;
    const double area = std::abs(cross(first, second));
    for (int step = 0; step < heights_tested; ++step) {
      const double t = tested_height(shell.heights, step);
      const Vec3 e1 = prisms[n].edge(1, t), e2 = prisms[n].edge(2, t);
      const Vec3 by_u = (1 / area) * (second.y * e1 - first.y * e2), by_v = (1 / area) * (first.x * e2 - second.x * e1);
      const auto [least, most] = squared_stretches(by_u, by_v);
      add(report.stretches, std::sqrt(least));
      add(report.stretches, std::sqrt(most));
      report.aspect = std::max(report.aspect, std::sqrt(most / least));
      for (const PrismPlace& at : {PrismPlace{0, 0, t}, {1, 0, t}, {0, 1, t}, {1.0 / 3, 1.0 / 3, t}})
        add(report.volumes, dot(prisms[n].normal(t), prisms[n].way(at)) / area);
    }
  }
  return report;
}

}  // namespace ombre::importing
