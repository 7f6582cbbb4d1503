// Generalized winding numbers: the share of the solid angle around a point that a surface covers, even with gaps.
#include "import/surfaces/solid_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ombre::importing {
namespace {

constexpr size_t fewest_for_dipoles = 1000;
constexpr uint32_t leaf_size = 8;
// Distance from a cluster, in radii, beyond which it counts as a dipole.
constexpr double far_factor = 2.3;

Vec3 area_vector(const std::array<Vec3, 3>& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]); }

// Returns the solid angle of a triangle (van Oosterom and Strackee 1983); 0 for triangles without area.
double triangle_angle(const std::array<Vec3, 3>& t, Vec3 p) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  const double volume = dot(a, cross(b, c));
  const double scale = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(volume, scale);
}

}  // namespace

SolidAngle::SolidAngle(SurfacePtr surface)
    : surface_(std::move(surface)),
      order_(surface_->triangles.size()),
      is_exact_(surface_->triangles.size() < fewest_for_dipoles) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) build(0, static_cast<uint32_t>(order_.size()));
}

Vec3 SolidAngle::centroid(uint32_t triangle) const {
  const auto [a, b, c] = surface_->corners(triangle);
  return (1.0 / 3) * (a + b + c);
}

// Splits the triangles in half along their longest side, so the depth is logarithmic.
uint32_t SolidAngle::build(uint32_t begin, uint32_t end) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({});
  nodes_[index].begin = begin;
  nodes_[index].end = end;
  summarize(nodes_[index]);
  if (end - begin <= leaf_size) return index;

  Box centroids;
  for (uint32_t i = begin; i < end; ++i) centroids = hull(centroids, Box{centroid(order_[i]), centroid(order_[i])});
  const Vec3 size = centroids.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](uint32_t a, uint32_t b) { return centroid(a)[axis] < centroid(b)[axis]; });
  build(begin, middle);
  const uint32_t right = build(middle, end);
  nodes_[index].right = right;
  return index;
}

void SolidAngle::summarize(Node& node) const {
  double total = 0;
  Vec3 weighted, plain;
  for (uint32_t i = node.begin; i < node.end; ++i) {
    const Vec3 vector = area_vector(surface_->corners(order_[i]));
    const double area = length(vector);
    node.area_vector = node.area_vector + vector;
    weighted = weighted + area * centroid(order_[i]);
    plain = plain + centroid(order_[i]);
    total += area;
  }
  node.center = total > 0 ? (1 / total) * weighted : (1.0 / (node.end - node.begin)) * plain;
  for (uint32_t i = node.begin; i < node.end; ++i)
    for (const Vec3& corner : surface_->corners(order_[i]))
      node.radius = std::max(node.radius, length(corner - node.center));
}

double SolidAngle::winding(Vec3 p) const {
  double angle = 0;
  std::array<uint32_t, 64> waiting;  // the depth is at most 32
  size_t count = 0;
  if (!nodes_.empty()) waiting[count++] = 0;
  while (count > 0) {
    const uint32_t index = waiting[--count];
    const Node& node = nodes_[index];
    const Vec3 offset = node.center - p;
    const double distance = length(offset);
    if (!is_exact_ && distance > far_factor * node.radius) {
      angle += dot(node.area_vector, offset) / (distance * distance * distance);
    } else if (node.right == 0) {
      for (uint32_t i = node.begin; i < node.end; ++i) angle += triangle_angle(surface_->corners(order_[i]), p);
    } else {
      waiting[count++] = node.right;
      waiting[count++] = index + 1;
    }
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace ombre::importing
