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

// A block of numbers, with x varying fastest.
struct NumberGrid {
  std::array<int64_t, 3> size{};
  std::vector<double> values;
};

// Computes centre * value + scale * (weighted sum of the voxels around). Sums are always taken in the same order, so
// that results do not depend on a voxel's position. Of n weights along an axis, the one with index floor(n / 2) belongs
// to the voxel itself. Weights belong to the voxels at their positions; the kernel is not mirrored.
class LinearFilter {
 public:
  // Makes a filter from a kernel. If its weights are the product of three lists, the cost is the sum of their lengths
  // instead of the number of weights. Weights are divided by their sum, unless that is 0.
  static LinearFilter of(const design::Kernel& kernel);
  // Makes a Gaussian filter with weights exp(-x^2 / (2 sigma^2)) up to four sigmas. Sigmas are in voxels; 0 leaves an
  // axis unchanged.
  static LinearFilter gaussian(Vec3 sigma);
  // Returns a filter for unsharp masking: the values plus `amount` times the difference between them and the filtered
  // ones.
  LinearFilter sharpened(double amount) const;

  // Return the number of voxels below and above each voxel that are read.
  std::array<int64_t, 3> below() const;
  std::array<int64_t, 3> above() const;
  // Returns an interval that encloses the results for values from 0 to 1.
  Interval range() const;

  // Applies the filter. The result is smaller than the grid by `below` and `above`. Throws Cancelled soon after `stop`,
  // which may be null, is set.
  NumberGrid apply(const NumberGrid& grid, const StopFlag* stop = nullptr) const;

 private:
  // One box of weights.
  struct Pass {
    std::array<int64_t, 3> size{1, 1, 1};
    std::vector<double> weights;  // x varies fastest
  };
  static Pass along(size_t axis, std::vector<double> weights);
  static NumberGrid applied(const Pass& pass, const NumberGrid& grid, const StopFlag* stop);

  std::vector<Pass> passes_;
  double centre_ = 0, scale_ = 1;
};

}  // namespace ombre::nodes
