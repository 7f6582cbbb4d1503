#include "surface/cells/point_evaluator.h"

#include <algorithm>

namespace ombre::surface {

void PointEvaluator::begin(const Partition& partition, const program::Program& program) {
  partition_ = &partition;
  program_ = &program;
}

void PointEvaluator::ask(const std::vector<Vec3>& points) {
  count_ = points.size();
  answers_.resize(program_->outputs.size() * count_);
  for (size_t begin = 0; begin < count_; begin += width) {
    const size_t n = std::min(width, count_ - begin);
    for (int axis = 0; axis < 3; ++axis) {
      coordinates_[axis].resize(n);
      for (size_t i = 0; i < n; ++i) coordinates_[axis][i] = points[begin + i][axis];
    }
    rows_.set_points(coordinates_[0], coordinates_[1], coordinates_[2]);
    rows_.run(*program_, 0, program_->code.size(), nullptr);
    for (size_t output = 0; output < program_->outputs.size(); ++output)
      std::ranges::copy(rows_.values(program_->outputs[output]),
                        answers_.begin() + static_cast<std::ptrdiff_t>(output * count_ + begin));
  }
}

double PointEvaluator::between(Label a, Label b, size_t n) const {
  const double distance = value(Partition::distance_output, n);
  if (b == 0) return distance;
  if (a == 0) return -distance;
  if (partition_->division == Division::greatest)
    return value(Partition::first_score + b - 1, n) - value(Partition::first_score + a - 1, n);
  // Bands that are not neighbours are separated at the middle one of the borders between them.
  const double past = value(Partition::first_score, n) - partition_->borders[(a + b) / 2 - 1];
  return a < b ? past : -past;
}

}  // namespace ombre::surface
