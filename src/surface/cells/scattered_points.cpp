#include "surface/cells/scattered_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "surface/cells/point_evaluator.h"
#include "surface/cells/shortened.h"

namespace ombre::surface {
namespace {

constexpr size_t most_points = 8192;  // greatest number of points per task
constexpr size_t fewest_points = 8;   // least number of points for which a program is shortened again
constexpr size_t most_work = 40000;   // points times operations; less work is not split further

using Numbers = std::span<uint32_t>;

Box box_of(const std::vector<Vec3>& points, Numbers numbers) {
  Box box;
  for (const uint32_t n : numbers) box = hull(box, {points[n], points[n]});
  return box;
}

// Splits points at a plane across the longest side of their box into two halves of about equal size.
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
  if (numbers.empty()) return;
  if (numbers.size() <= most_points) return tasks.push_back(numbers);
  const auto [one, two] = halves(points, box_of(points, numbers), numbers);
  cut_into_tasks(points, one, tasks);
  cut_into_tasks(points, two, tasks);
}

// Divides the box around all points into equal boxes, with a few thousand points each if they are spread evenly over a
// surface.
class Boxes {
 public:
  explicit Boxes(const std::vector<Vec3>& points) {
    Box whole;
    for (const Vec3& point : points) whole = hull(whole, {point, point});
    origin_ = whole.lo;
    const double along = std::sqrt(static_cast<double>(points.size()) / most_points);
    count_ = static_cast<size_t>(std::clamp(std::ceil(along), 1.0, 128.0));
    for (int axis = 0; axis < 3; ++axis)
      scale_[axis] = whole.size()[axis] > 0 ? static_cast<double>(count_) / whole.size()[axis] : 0;
  }
  size_t count() const { return count_ * count_ * count_; }
  size_t of(Vec3 point) const {
    size_t number = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const auto along = static_cast<size_t>((point[axis] - origin_[axis]) * scale_[axis]);
      number = number * count_ + std::min(along, count_ - 1);
    }
    return number;
  }

 private:
  Vec3 origin_, scale_;
  size_t count_ = 1;
};

// Numbers of the points, ordered by box, and the index at which each box begins.
struct Sorted {
  std::vector<uint32_t> numbers;
  std::vector<size_t> begins;
};

Sorted sort_into_boxes(const std::vector<Vec3>& points) {
  const Boxes boxes(points);
  Sorted sorted{std::vector<uint32_t>(points.size()), std::vector<size_t>(boxes.count() + 2)};
  for (const Vec3& point : points) ++sorted.begins[boxes.of(point) + 2];
  std::partial_sum(sorted.begins.begin(), sorted.begins.end(), sorted.begins.begin());
  for (uint32_t n = 0; n < points.size(); ++n) sorted.numbers[sorted.begins[boxes.of(points[n]) + 1]++] = n;
  return sorted;
}

class Task {
 public:
  Task(const std::vector<Vec3>& points, double margin_mm, const StopFlag* stop, const PointWork& work)
      : points_(points), margin_mm_(margin_mm), stop_(stop), work_(work) {}

  void run(const ProgramAround& around, Numbers numbers) const {
    const Box box = box_of(points_, numbers);
    run(around(box.expanded(margin_mm_)), box, numbers);
  }

 private:
  void run(const program::Program& above, const Box& box, Numbers numbers) const {
    if (stop_ && stop_->requested()) throw Cancelled();
    const program::Program program = shortened_for(above, box.expanded(margin_mm_));
    if (numbers.size() <= fewest_points || numbers.size() * program.code.size() <= most_work)
      return work_(program, numbers);
    const auto [one, two] = halves(points_, box, numbers);
    run(program, box_of(points_, one), one);
    run(program, box_of(points_, two), two);
  }

  const std::vector<Vec3>& points_;
  double margin_mm_;
  const StopFlag* stop_;
  const PointWork& work_;
};

}  // namespace

void work_at(const ProgramAround& program, const std::vector<Vec3>& points, double margin_mm, int threads,
             const StopFlag* stop, const PointWork& work) {
  if (points.empty()) return;
  Sorted sorted = sort_into_boxes(points);
  std::vector<Numbers> tasks;
  for (size_t n = 0; n + 1 < sorted.begins.size(); ++n)
    cut_into_tasks(points, Numbers(sorted.numbers).subspan(sorted.begins[n], sorted.begins[n + 1] - sorted.begins[n]),
                   tasks);
  const Task task(points, margin_mm, stop, work);
  run_parallel(tasks.size(), threads, [&](size_t n) { task.run(program, tasks[n]); });
}

}  // namespace ombre::surface
