#include "base/math/point_set_checks.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <vector>

#include "base/text/text.h"

namespace ombre {
namespace {

// Points count as coplanar if their distance from a plane is at most this fraction of their extent.
constexpr double flattest = 1e-9;

std::string counted(size_t least, size_t count) {
  return "at least " + std::to_string(least) + " points are needed, found " + std::to_string(count);
}

// Returns the indices of two equal points, or nothing.
std::optional<std::array<size_t, 2>> find_twins(std::span<const Vec3> points) {
  std::vector<size_t> order(points.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto key = [&](size_t n) { return std::array{points[n].x, points[n].y, points[n].z}; };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
  std::optional<std::array<size_t, 2>> found;
  for (size_t n = 1; n < order.size(); ++n)
    if (key(order[n]) == key(order[n - 1]) && (!found || order[n] < (*found)[1])) found = {order[n - 1], order[n]};
  return found;
}

template <class Measure>
Vec3 farthest(std::span<const Vec3> points, const Measure& measure) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vec3& a, const Vec3& b) { return measure(a) < measure(b); });
}

bool are_in_plane(std::span<const Vec3> points) {
  const Vec3 a = points[0], b = farthest(points, [&](Vec3 p) { return length(p - a); });
  const double size = length(b - a);
  const Vec3 c = farthest(points, [&](Vec3 p) { return length(cross(b - a, p - a)); });
  const Vec3 area = cross(b - a, c - a);
  if (!(length(area) > flattest * size * size)) return true;
  const Vec3 d = farthest(points, [&](Vec3 p) { return std::abs(dot(area, p - a)); });
  return !(std::abs(dot(area, d - a)) > flattest * size * length(area));
}

}  // namespace

std::string problem_of_points(std::span<const Vec3> points, size_t least, size_t most, bool may_repeat) {
  if (points.size() < least) return counted(least, points.size());
  if (points.size() > most) return "at most " + format_count(most) + " points, found " + format_count(points.size());
  for (size_t n = 0; n < points.size(); ++n)
    if (!is_finite(points[n])) return "point " + std::to_string(n + 1) + " is not finite";
  if (!may_repeat)
    if (const auto twins = find_twins(points))
      return "points " + std::to_string((*twins)[0] + 1) + " and " + std::to_string((*twins)[1] + 1) + " are the same";
  return are_in_plane(points) ? "all points lie in one plane" : "";
}

}  // namespace ombre
