// Weighted sums of the voxels around each voxel.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/math/index_box.h"
#include "base/math/interval.h"
#include "base/math/vec.h"
#include "base/system/progress.h"
#include "design/values.h"

namespace ombre::nodes {

// A block of numbers, x fastest.
struct NumberGrid {
  std::array<int64_t, 3> size{};
  std::vector<double> values;
};

// value = centre * own + scale * (weighted sum around). Sums are taken in one order, so that they are the same bits
// wherever a voxel lies. The voxel itself has the index floor(n / 2) of the n weights along an axis, and the weights
// are those of the voxels at that place, not mirrored.
class LinearFilter {
 public:
  // Weights that are a product of three lists cost the sum of their lengths, others their number. They are divided by
  // their sum, unless that is 0.
  static LinearFilter of(const design::Kernel& kernel);
  // Weights exp(-x^2 / (2 sigma^2)) up to four sigmas away; sigmas in voxels, 0 leaves an axis as it is.
  static LinearFilter gaussian(Vec3 sigma);
  // Unsharp masking: the values themselves plus `amount` times what the filter takes from them.
  LinearFilter sharpened(double amount) const;

  // Voxels that are read below and above each.
  std::array<int64_t, 3> below() const;
  std::array<int64_t, 3> above() const;
  // Encloses the results for values from 0 to 1.
  Interval range() const;

  // The grid's outermost voxels are only read: the result is smaller by `below` and `above`. Throws Cancelled soon
  // after `stop`, which may be null, asks for it.
  NumberGrid apply(const NumberGrid& grid, const StopFlag* stop = nullptr) const;

 private:
  // One box of weights.
  struct Pass {
    std::array<int64_t, 3> size{1, 1, 1};
    std::vector<double> weights;  // x fastest
  };
  static Pass along(size_t axis, std::vector<double> weights);
  static NumberGrid applied(const Pass& pass, const NumberGrid& grid, const StopFlag* stop);

  std::vector<Pass> passes_;
  double centre_ = 0, scale_ = 1;
};

}  // namespace ombre::nodes
