#include "import/surfaces/winding_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ombre::importing {
namespace {

constexpr double least_boxes = 1 << 20, most_boxes = 1 << 22, boxes_of_triangle = 2, most_along = 1024;
// limit on flags of boxes set by large triangles; boxes become larger if it is exceeded
constexpr double most_flags = 1 << 26;
// Limits beyond which PointWinding is faster than following a ray.
constexpr int64_t most_boxes_of_ray = 100, most_triangles_of_ray = 500;
constexpr int8_t unknown = std::numeric_limits<int8_t>::min();
// Margin of boxes, relative to their size and to coordinates; far larger than rounding errors.
constexpr double slack_of_size = 1e-6, slack_of_coordinates = 1e-12;

double largest(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

WindingCells::WindingCells(const PointWinding& winding) : winding_(winding), bounds_(bounds(winding.surface())) {
  if (bounds_.is_empty()) return;
  const Vec3 whole = bounds_.size();
  const double volume = whole.x * whole.y * whole.z;
  if (!(volume > 0) || !std::isfinite(volume)) return;
  const auto triangles = static_cast<double>(winding.surface().triangles.size());
  double boxes = std::clamp(boxes_of_triangle * triangles, least_boxes, most_boxes);
  cut_into(boxes);
  while (boxes > 1 && flags() > most_flags) cut_into(boxes /= 8);
  list_triangles();
  fill();
}

// Chooses about `boxes` boxes. They are long in the direction of the rays, which then cross fewer of them.
void WindingCells::cut_into(double boxes) {
  const Vec3 whole = bounds_.size();
  const double usual = std::cbrt(whole.x * whole.y * whole.z / boxes);
  for (int axis = 0; axis < 3; ++axis) {
    const double wanted = usual * (axis == 0 ? 4.0 : 0.5);
    const double along = std::clamp(std::ceil(whole[axis] / wanted), 1.0, most_along);
    count_[static_cast<size_t>(axis)] = static_cast<int64_t>(along);
    size_mm_[axis] = whole[axis] / along;
  }
  slack_mm_ =
      slack_of_size * largest(size_mm_) + slack_of_coordinates * std::max(largest(bounds_.lo), largest(bounds_.hi));
}

double WindingCells::flags() const {
  const Surface& surface = winding_.surface();
  double sum = 0;
  for (uint32_t n = 0; n < surface.triangles.size(); ++n) {
    const auto [lo, hi] = around(surface.corners(n));
    double boxes = 1;
    for (size_t axis = 0; axis < 3; ++axis) boxes *= static_cast<double>(hi[axis] - lo[axis] + 1);
    sum += boxes;
  }
  return sum;
}

std::optional<int64_t> WindingCells::at(Vec3 p) const {
  if (windings_.empty() || !bounds_.contains(p)) return std::nullopt;
  const int64_t first = along(0, p.x);
  const size_t row = number({0, along(1, p.y), along(2, p.z)});
  const int64_t last = std::max<int64_t>(first - most_boxes_of_ray, -1);
  int64_t sum = 0, triangles = 0;
  for (int64_t i = first; i > last; --i) {
    const size_t box = row + static_cast<size_t>(i);
    if (windings_[box] != unknown) return sum + windings_[box];
    triangles += begins_[box + 1] - begins_[box];
    if (triangles > most_triangles_of_ray) return std::nullopt;
    for (uint32_t n = begins_[box]; n < begins_[box + 1]; ++n) {
      const auto crossing = winding_.crossing(triangles_[n], p);
      if (crossing.way != 0 && along(0, crossing.x) == i) sum += crossing.way;
    }
  }
  return last < 0 ? std::optional(sum) : std::nullopt;
}

// Returns the index of the box along an axis that contains a position within the bounds.
int64_t WindingCells::along(int axis, double at) const {
  return std::min(static_cast<int64_t>((at - bounds_.lo[axis]) / size_mm_[axis]),
                  count_[static_cast<size_t>(axis)] - 1);
}

size_t WindingCells::number(const Place& place) const {
  return static_cast<size_t>((place[2] * count_[1] + place[1]) * count_[0] + place[0]);
}

Vec3 WindingCells::middle(const Place& place) const {
  Vec3 middle;
  for (int axis = 0; axis < 3; ++axis)
    middle[axis] = bounds_.lo[axis] + (static_cast<double>(place[static_cast<size_t>(axis)]) + 0.5) * size_mm_[axis];
  return middle;
}

// Returns the first and the last box around a triangle along each axis.
std::pair<WindingCells::Place, WindingCells::Place> WindingCells::around(const std::array<Vec3, 3>& corners) const {
  const auto& [a, b, c] = corners;
  Place lo, hi;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<size_t>(axis);
    const auto along = [&](double at) {
      const double place = std::floor((at - bounds_.lo[axis]) / size_mm_[axis]);
      return static_cast<int64_t>(std::clamp(place, 0.0, static_cast<double>(count_[n] - 1)));
    };
    lo[n] = along(std::min({a[axis], b[axis], c[axis]}) - slack_mm_);
    hi[n] = along(std::max({a[axis], b[axis], c[axis]}) + slack_mm_);
  }
  return {lo, hi};
}

// Visits all boxes that the triangle meets, and some beside it.
template <class Visit>
void WindingCells::for_boxes(const std::array<Vec3, 3>& corners, const Visit& visit) const {
  const auto& [a, b, c] = corners;
  const auto [lo, hi] = around(corners);
  const Vec3 normal = cross(b - a, c - a);
  double reach = 0;  // half the extent of a box along the normal
  for (int axis = 0; axis < 3; ++axis) reach += std::abs(normal[axis]) * (0.5 * size_mm_[axis] + slack_mm_);
  Place place;
  for (place[2] = lo[2]; place[2] <= hi[2]; ++place[2])
    for (place[1] = lo[1]; place[1] <= hi[1]; ++place[1])
      for (place[0] = lo[0]; place[0] <= hi[0]; ++place[0])
        if (std::abs(dot(normal, middle(place) - a)) <= reach) visit(number(place));
}

void WindingCells::list_triangles() {
  const Surface& surface = winding_.surface();
  windings_.resize(static_cast<size_t>(count_[0] * count_[1] * count_[2]));
  begins_.resize(windings_.size() + 1);
  const auto for_all = [&](const auto& visit) {
    for (uint32_t n = 0; n < surface.triangles.size(); ++n)
      for_boxes(surface.corners(n), [&](size_t box) { visit(box, n); });
  };
  for_all([&](size_t box, uint32_t) {
    ++begins_[box];
    windings_[box] = unknown;
  });
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  triangles_.resize(begins_.back());
  for_all([&](size_t box, uint32_t n) { triangles_[--begins_[box]] = n; });
}

void WindingCells::fill() {
  Place place;
  for (place[2] = 0; place[2] < count_[2]; ++place[2])
    for (place[1] = 0; place[1] < count_[1]; ++place[1])
      for (place[0] = 0; place[0] < count_[0]; ++place[0]) {
        int8_t& here = windings_[number(place)];
        if (here != unknown) here = filled(place);
      }
}

// Returns the winding number in a box that no triangle meets: that of a filled neighbour if there is one, since no
// triangle lies between them, else that at its middle.
int8_t WindingCells::filled(const Place& place) const {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (place[axis] == 0) continue;
    Place before = place;
    --before[axis];
    const int8_t there = windings_[number(before)];
    if (there != unknown) return there;
  }
  const int64_t winding = winding_.at(middle(place));
  return std::abs(winding) < std::numeric_limits<int8_t>::max() ? static_cast<int8_t>(winding) : unknown;
}

}  // namespace ombre::importing
