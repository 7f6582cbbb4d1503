#include "surface/mesh/border_offsets.h"

#include "surface/cells/edge_search.h"
#include "surface/cells/scattered_points.h"

namespace ombre::surface {
namespace {

EdgeSearch search_of(const BorderSample& sample, double reach_mm) {
  EdgeSearch search;
  search.start = sample.at - reach_mm * sample.normal;
  search.along = 2 * reach_mm * sample.normal;
  search.from = sample.from;
  search.to = sample.to;
  return search;
}

}  // namespace

std::vector<std::optional<double>> border_offsets(const Partition& partition, const std::vector<BorderSample>& samples,
                                                  double reach_mm, int threads, const StopFlag* stop) {
  std::vector<Vec3> points;
  points.reserve(samples.size());
  for (const BorderSample& sample : samples) points.push_back(sample.at);
  std::vector<std::optional<double>> offsets(samples.size());
  const auto details = [&](const Box& box) -> const program::Program& { return partition.details.around(box); };
  work_at(details, points, reach_mm, threads, stop,
          [&](const program::Program& program, std::span<const uint32_t> numbers) {
            PointEvaluator evaluator;
            evaluator.begin(partition, program);
            std::vector<EdgeSearch> searches;
            for (const uint32_t n : numbers) searches.push_back(search_of(samples[n], reach_mm));
            search_edges(searches, evaluator);
            for (size_t m = 0; m < numbers.size(); ++m)
              if (searches[m].is_between) offsets[numbers[m]] = (2 * searches[m].t - 1) * reach_mm;
          });
  return offsets;
}

}  // namespace ombre::surface
