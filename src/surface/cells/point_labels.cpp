#include "surface/cells/point_labels.h"

#include "surface/cells/point_evaluator.h"
#include "surface/cells/scattered_points.h"

namespace ombre::surface {

std::vector<Label> labels_at(const Partition& partition, const std::vector<Vec3>& points, int threads,
                             const StopFlag* stop) {
  std::vector<Label> labels(points.size());
  const auto label = [&](const Box&) -> const program::Program& { return partition.label; };
  work_at(label, points, 0, threads, stop, [&](const program::Program& program, std::span<const uint32_t> numbers) {
    PointEvaluator evaluator;
    evaluator.begin(partition, program);
    std::vector<Vec3> queried;
    for (const uint32_t n : numbers) queried.push_back(points[n]);
    evaluator.ask(queried);
    for (size_t m = 0; m < numbers.size(); ++m) labels[numbers[m]] = evaluator.label(m);
  });
  return labels;
}

}  // namespace ombre::surface
