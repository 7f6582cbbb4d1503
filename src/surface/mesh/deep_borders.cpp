#include "surface/mesh/deep_borders.h"

#include <algorithm>
#include <functional>
#include <span>

#include "surface/cells/point_labels.h"

namespace ombre::surface {
namespace {

constexpr double most_reaches = 4;
constexpr size_t steps = 12, fine_steps = 8;

// A segment of a sample's normal, in either direction.
struct Way {
  uint32_t sample = 0;
  Vec3 from, to;

  Vec3 point(double share) const { return from + share * (to - from); }
};

// Divides each way into `step_count` equal steps and returns the first step over which the label changes; ways without
// a change are dropped.
std::vector<Way> first_changes(const Partition& partition, const std::vector<Way>& ways, size_t step_count, int threads,
                               const StopFlag* stop) {
  const double step = 1 / static_cast<double>(step_count);
  std::vector<Vec3> points;
  for (const Way& way : ways)
    for (size_t n = 0; n <= step_count; ++n) points.push_back(way.point(static_cast<double>(n) * step));
  const std::vector<Label> labels = labels_at(partition, points, threads, stop);
  std::vector<Way> changes;
  for (size_t n = 0; n < ways.size(); ++n) {
    const std::span<const Label> along(&labels[n * (step_count + 1)], step_count + 1);
    const auto change = std::ranges::adjacent_find(along, std::not_equal_to<>());
    if (change == along.end()) continue;
    const auto before = static_cast<double>(change - along.begin());
    changes.push_back({ways[n].sample, ways[n].point(before * step), ways[n].point((before + 1) * step)});
  }
  return changes;
}

}  // namespace

std::vector<DeepBorder> find_deep_borders(const Partition& partition, const std::vector<SurfaceSample>& samples,
                                          const std::vector<uint32_t>& numbers, double reach_mm, int threads,
                                          const StopFlag* stop) {
  std::vector<Way> ways;
  for (const uint32_t n : numbers) {
    const Vec3 reach = reach_mm * samples[n].normal;
    ways.push_back({n, samples[n].at - reach, samples[n].at - most_reaches * reach});
    ways.push_back({n, samples[n].at + reach, samples[n].at + most_reaches * reach});
  }
  // The steps are refined in few passes, because nearby points are cheaper to evaluate together.
  for (const size_t count : {steps, fine_steps}) ways = first_changes(partition, ways, count, threads, stop);
  std::vector<DeepBorder> borders;
  for (const Way& way : ways) borders.push_back({way.sample, way.point(0.5)});
  return borders;
}

}  // namespace ombre::surface
