#include "surface/label_asker.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/error.h"
#include "base/tasks.h"
#include "surface/point_asker.h"

namespace ombre::surface {
namespace {

constexpr size_t most_points = 8192;  // of a task
constexpr size_t fewest_points = 32;  // for which a program is shortened once more
constexpr size_t most_work = 40000;   // points times operations of a program that is not shortened further

using Numbers = std::span<uint32_t>;

Box box_of(const std::vector<Vec3>& points, Numbers numbers) {
  Box box;
  for (const uint32_t n : numbers) box = hull(box, {points[n], points[n]});
  return box;
}

// Halves of about the same number, on both sides of a plane across the longest side of their box.
std::pair<Numbers, Numbers> halves(const std::vector<Vec3>& points, const Box& box, Numbers numbers) {
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const size_t middle = numbers.size() / 2;
  std::nth_element(
      numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(middle), numbers.end(),
      [&](uint32_t a, uint32_t b) { return std::pair(points[a][axis], a) < std::pair(points[b][axis], b); });
  return {numbers.first(middle), numbers.subspan(middle)};
}

void cut_into_tasks(const std::vector<Vec3>& points, Numbers numbers, std::vector<Numbers>& tasks) {
  if (numbers.size() <= most_points) return tasks.push_back(numbers);
  const auto [one, two] = halves(points, box_of(points, numbers), numbers);
  cut_into_tasks(points, one, tasks);
  cut_into_tasks(points, two, tasks);
}

class TaskAsker {
 public:
  TaskAsker(const Partition& partition, const std::vector<Vec3>& points, std::vector<Label>& labels,
            const StopFlag* stop)
      : partition_(partition), points_(points), labels_(labels), stop_(stop) {}

  void ask(const program::Program& above, Numbers numbers) {
    if (stop_ && stop_->requested()) throw Cancelled();
    const Box box = box_of(points_, numbers);
    const program::Program program = shortened_for(above, box);
    if (numbers.size() > fewest_points && numbers.size() * program.code.size() > most_work) {
      const auto [one, two] = halves(points_, box, numbers);
      ask(program, one);
      ask(program, two);
      return;
    }
    asker_.begin(partition_, program);
    std::vector<Vec3> asked;
    for (const uint32_t n : numbers) asked.push_back(points_[n]);
    asker_.ask(asked);
    for (size_t m = 0; m < numbers.size(); ++m) labels_[numbers[m]] = asker_.label(m);
  }

 private:
  const Partition& partition_;
  const std::vector<Vec3>& points_;
  std::vector<Label>& labels_;
  const StopFlag* stop_;
  PointAsker asker_;
};

}  // namespace

std::vector<Label> labels_at(const Partition& partition, const std::vector<Vec3>& points, int threads,
                             const StopFlag* stop) {
  std::vector<Label> labels(points.size());
  if (points.empty()) return labels;
  std::vector<uint32_t> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::vector<Numbers> tasks;
  cut_into_tasks(points, numbers, tasks);
  run_parallel(tasks.size(), threads,
               [&](size_t n) { TaskAsker(partition, points, labels, stop).ask(partition.label, tasks[n]); });
  return labels;
}

}  // namespace ombre::surface
