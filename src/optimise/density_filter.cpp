#include "optimise/density_filter.h"

#include <algorithm>
#include <cmath>

namespace ombre::optimise {

DensityFilter::DensityFilter(const fea::Bricks& bricks, double radius_mm, int threads)
    : bricks_(bricks), threads_(threads) {
  fea::Cell high = low_ = bricks.cells.front(), reach{};
  for (const fea::Cell& cell : bricks.cells)
    for (size_t axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis]);
    }
  for (size_t axis = 0; axis < 3; ++axis) {
    count_[axis] = high[axis] - low_[axis] + 1;
    const double size = bricks.size_mm[static_cast<int>(axis)];
    reach[axis] = static_cast<int32_t>(std::min<double>(std::floor(radius_mm / size), count_[axis]));
  }
  brick_at_.assign(static_cast<size_t>(int64_t{count_[0]} * count_[1] * count_[2]), -1);
  for (size_t n = 0; n < bricks.count(); ++n)
    brick_at_[static_cast<size_t>(place(bricks.cells[n]))] = static_cast<int32_t>(n);
  for (int32_t k = -reach[2]; k <= reach[2]; ++k)
    for (int32_t j = -reach[1]; j <= reach[1]; ++j)
      for (int32_t i = -reach[0]; i <= reach[0]; ++i) {
        const double distance = length(Vec3{i * bricks.size_mm.x, j * bricks.size_mm.y, k * bricks.size_mm.z});
        if (distance < radius_mm) neighbours_.push_back({{i, j, k}, radius_mm - distance});
      }
  if (neighbours_.empty()) neighbours_.push_back({{0, 0, 0}, 1});
  weights_ = sums(fea::Vector(bricks.count(), 1));
}

int64_t DensityFilter::place(const fea::Cell& cell) const {
  for (size_t axis = 0; axis < 3; ++axis)
    if (cell[axis] < low_[axis] || cell[axis] >= low_[axis] + count_[axis]) return -1;
  return (int64_t{cell[2] - low_[2]} * count_[1] + (cell[1] - low_[1])) * count_[0] + (cell[0] - low_[0]);
}

fea::Vector DensityFilter::sums(const fea::Vector& values) const {
  fea::Vector result(values.size());
  fea::for_pieces(values.size(), threads_, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n) {
      const fea::Cell& cell = bricks_.cells[n];
      double sum = 0;
      for (const auto& [offset, weight] : neighbours_) {
        const int64_t at = place({cell[0] + offset[0], cell[1] + offset[1], cell[2] + offset[2]});
        const int32_t other = at < 0 ? -1 : brick_at_[static_cast<size_t>(at)];
        if (other >= 0) sum += weight * values[static_cast<size_t>(other)];
      }
      result[n] = sum;
    }
  });
  return result;
}

fea::Vector DensityFilter::apply(const fea::Vector& values) const {
  fea::Vector means = sums(values);
  for (size_t n = 0; n < means.size(); ++n) means[n] /= weights_[n];
  return means;
}

fea::Vector DensityFilter::apply_transposed(const fea::Vector& gradient) const {
  fea::Vector shares(gradient.size());
  for (size_t n = 0; n < shares.size(); ++n) shares[n] = gradient[n] / weights_[n];
  return sums(shares);
}

}  // namespace ombre::optimise
