#include "import/surfaces/triangle_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace ombre::importing {
namespace {

// Rounding error of squared distances.
constexpr float slack = 16 * std::numeric_limits<float>::epsilon();

// Returns max(x, 0) without a branch, so that compilers can vectorize it.
float positive_part(float x) { return 0.5F * (x + std::abs(x)); }

Box box_of(const std::array<Vec3, 3>& t) { return hull(hull(Box{t[0], t[0]}, Box{t[1], t[1]}), Box{t[2], t[2]}); }

struct Disc {
  Vec3 middle, normal;
  double radius = 0;

  explicit Disc(const std::array<Vec3, 3>& t) : middle(box_of(t).center()) {
    const Vec3 across = cross(t[1] - t[0], t[2] - t[0]);
    if (const double size = length(across); size > 0) {
      normal = (1 / size) * across;
      middle = middle - dot(middle - t[0], normal) * normal;
    }
    for (const Vec3& corner : t) radius = std::max(radius, length(corner - middle));
  }
};

class ClusterMaker {
 public:
  ClusterMaker(const Surface& surface, const Frame& frame)
      : surface_(surface), frame_(frame), order_(surface.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    for (uint32_t n = 0; n < order_.size(); ++n) middles_.push_back(box_of(surface.corners(n)).center());
  }

  std::vector<TriangleCluster> make() {
    if (!order_.empty()) cut(order_);
    return std::move(clusters_);
  }

 private:
  // Halves the triangles along the longest side until they fit into clusters; parts are whole clusters.
  void cut(std::span<uint32_t> triangles) {
    constexpr size_t most = TriangleCluster::most;
    if (triangles.size() <= most) return add(triangles);
    Box box;
    for (const uint32_t n : triangles) box = hull(box, {middles_[n], middles_[n]});
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const size_t half = (triangles.size() / 2 + most - 1) / most * most;
    std::nth_element(
        triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
        [&](uint32_t a, uint32_t b) { return std::pair(middles_[a][axis], a) < std::pair(middles_[b][axis], b); });
    cut(triangles.first(half));
    cut(triangles.subspan(half));
  }

  void add(std::span<const uint32_t> triangles) {
    TriangleCluster cluster;
    Box box;
    for (const uint32_t triangle : triangles) {
      std::array<Vec3, 3> corners = surface_.corners(triangle);
      for (Vec3& corner : corners) corner = frame_(corner);
      box = hull(box, box_of(corners));
      const Disc disc(corners);
      const size_t n = cluster.count++;
      cluster.triangles[n] = triangle;
      cluster.x[n] = static_cast<float>(disc.middle.x);
      cluster.y[n] = static_cast<float>(disc.middle.y);
      cluster.z[n] = static_cast<float>(disc.middle.z);
      cluster.across_x[n] = static_cast<float>(disc.normal.x);
      cluster.across_y[n] = static_cast<float>(disc.normal.y);
      cluster.across_z[n] = static_cast<float>(disc.normal.z);
      cluster.radius[n] = static_cast<float>(disc.radius);
    }
    for (int axis = 0; axis < 3; ++axis) {
      cluster.lo[static_cast<size_t>(axis)] = static_cast<float>(box.lo[axis]);
      cluster.hi[static_cast<size_t>(axis)] = static_cast<float>(box.hi[axis]);
    }
    clusters_.push_back(cluster);
  }

  const Surface& surface_;
  const Frame& frame_;
  std::vector<uint32_t> order_;
  std::vector<Vec3> middles_;
  std::vector<TriangleCluster> clusters_;
};

}  // namespace

Frame::Frame(const Box& box) : center(box.center()) {
  const Vec3 half = 0.5 * box.size();
  const double widest = std::max({half.x, half.y, half.z});
  if (widest > 0) scale = 1 / widest;
}

// A point at `height` over a disc's plane and at `width` from its axis is sqrt(height^2 + (width - radius)^2) away from
// the disc, or `height` if it lies over the disc.
uint32_t TriangleCluster::within(const std::array<float, 3>& point, float reach) const {
  const float squared_reach = reach * reach * (1 + slack);
  Row squared;  // NOLINT: set below
  for (size_t n = 0; n < most; ++n) {
    const float way_x = point[0] - x[n], way_y = point[1] - y[n], way_z = point[2] - z[n];
    const float height = way_x * across_x[n] + way_y * across_y[n] + way_z * across_z[n];
    const float squared_way = way_x * way_x + way_y * way_y + way_z * way_z;
    const float squared_width = squared_way - height * height;
    const float beside = positive_part(std::sqrt(positive_part(squared_width)) - radius[n]);
    squared[n] = height * height + beside * beside - slack * squared_way;
  }
  uint32_t found = 0;
  for (uint32_t n = 0; n < count; ++n) found |= static_cast<uint32_t>(!(squared[n] > squared_reach)) << n;
  return found;
}

std::vector<TriangleCluster> cluster_triangles(const Surface& surface, const Frame& frame) {
  return ClusterMaker(surface, frame).make();
}

}  // namespace ombre::importing
