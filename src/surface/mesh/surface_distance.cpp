#include "surface/mesh/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>

#include "surface/cells/point_labels.h"

namespace ombre::surface {
namespace {

// Number of directions around a sample, and the distances searched, as shares of the reach.
struct Ways {
  int count;
  std::array<double, 4> shares;
};
constexpr Ways few_ways{40, {1.0, 0.5, 0, 0}}, many_ways{98, {1.0, 0.6, 0.3, 0.1}};
constexpr double golden_angle = 2.399963229728653;  // angle of the Fibonacci lattice on the sphere

Vec3 way_around(int n, int count) {
  const double z = 1 - 2 * (n + 0.5) / count, radius = std::sqrt(1 - z * z);
  return {radius * std::cos(golden_angle * n), radius * std::sin(golden_angle * n), z};
}

class FarFinder {
 public:
  FarFinder(const Partition& partition, const std::vector<SurfaceSample>& samples, int threads, const StopFlag* stop)
      : partition_(partition), samples_(samples), threads_(threads), stop_(stop), open_(samples.size()) {
    std::iota(open_.begin(), open_.end(), 0U);
  }

  FarSamples find(double reach_mm, const Ways& ways) {
    search_along_normals(reach_mm);
    const std::vector<uint32_t> across = open_;
    // Short distances find thin walls.
    for (const double share : {0.3, 0.1, 0.02}) search_along_normals(share * reach_mm);
    for (const double share : ways.shares)
      if (share > 0) search_around(share * reach_mm, ways.count);
    std::vector<uint32_t> near;
    std::ranges::set_difference(across, open_, std::back_inserter(near));
    return {open_, near};
  }

 private:
  // Evaluates `ways` points around each open sample; a sample stays open if all its points have the same label.
  template <class PointOf>
  void search(int ways, const PointOf& point_of) {
    std::vector<Vec3> points;
    for (const uint32_t n : open_)
      for (int way = 0; way < ways; ++way) points.push_back(point_of(samples_[n], way));
    const std::vector<Label> labels = labels_at(partition_, points, threads_, stop_);
    std::vector<uint32_t> still;
    for (size_t n = 0; n < open_.size(); ++n) {
      const auto first = labels.begin() + static_cast<std::ptrdiff_t>(n * static_cast<size_t>(ways));
      if (std::adjacent_find(first, first + ways, std::not_equal_to<>()) == first + ways) still.push_back(open_[n]);
    }
    open_ = std::move(still);
  }

  void search_along_normals(double reach) {
    search(2, [&](const SurfaceSample& s, int way) { return s.at + (way == 0 ? -reach : reach) * s.normal; });
  }

  void search_around(double reach, int ways) {
    search(ways + 1,
           [&](const SurfaceSample& s, int way) { return way == 0 ? s.at : s.at + reach * way_around(way - 1, ways); });
  }

  const Partition& partition_;
  const std::vector<SurfaceSample>& samples_;
  int threads_;
  const StopFlag* stop_;
  std::vector<uint32_t> open_;
};

}  // namespace

FarSamples find_far_samples(const Partition& partition, const std::vector<SurfaceSample>& samples, double reach_mm,
                            int threads, const StopFlag* stop) {
  return FarFinder(partition, samples, threads, stop).find(reach_mm, few_ways);
}

double farthest_mm(const Partition& partition, std::vector<SurfaceSample> samples, double reach_mm, int threads,
                   const StopFlag* stop) {
  constexpr double most_reaches = 16, growth = 1.25;
  const auto keep_far = [&](double reach) {
    std::vector<SurfaceSample> far;
    for (const uint32_t n : FarFinder(partition, samples, threads, stop).find(reach, many_ways).far)
      far.push_back(samples[n]);
    samples = std::move(far);
  };
  double reach = reach_mm;
  keep_far(reach);
  while (!samples.empty() && reach < most_reaches * reach_mm) keep_far(reach *= growth);
  return std::min(reach, most_reaches * reach_mm);
}

// If the point projects into the triangle, the distance is that to its plane; else that to the nearest side.
double distance_to_triangle(Vec3 point, const std::array<Vec3, 3>& corners) {
  const auto [a, b, c] = corners;
  const Vec3 normal = cross(b - a, c - a);
  const double square = dot(normal, normal);
  bool is_over = square > 0;
  double nearest = 1e300;
  for (size_t n = 0; n < 3; ++n) {
    const Vec3 from = corners[n], along = corners[(n + 1) % 3] - from;
    is_over &= dot(cross(along, point - from), normal) >= 0;
    const double squared_length = dot(along, along);
    const double t = squared_length > 0 ? std::clamp(dot(point - from, along) / squared_length, 0.0, 1.0) : 0;
    nearest = std::min(nearest, length(point - from - t * along));
  }
  return is_over ? std::abs(dot(point - a, normal)) / std::sqrt(square) : nearest;
}

}  // namespace ombre::surface
