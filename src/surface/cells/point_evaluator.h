// Evaluates the details of a partition at scattered points, in double precision.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "eval/rows.h"
#include "surface/cells/partition.h"

namespace ombre::surface {

class PointEvaluator {
 public:
  // Selects the program for the next points; it must be valid in a region that contains them all.
  void begin(const Partition& partition, const program::Program& program);
  // Evaluates points; the results replace those of the previous call.
  void ask(const std::vector<Vec3>& points);

  Label label(size_t n) const { return static_cast<Label>(value(Partition::label_output, n)); }
  // Returns a number that rises from negative to positive on the way from region a to region b.
  double between(Label a, Label b, size_t n) const;

 private:
  static constexpr size_t width = 128;
  double value(size_t output, size_t n) const { return answers_[output * count_ + n]; }

  const Partition* partition_ = nullptr;
  const program::Program* program_ = nullptr;
  eval::RowEvaluator rows_{width};
  std::vector<double> coordinates_[3], answers_;
  size_t count_ = 0;
};

}  // namespace ombre::surface
