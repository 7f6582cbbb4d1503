// Small symmetric systems.
#pragma once

#include <cstddef>
#include <vector>

namespace ombre::fea {

// The factor of a symmetric matrix that is not negative; unknowns that it does not decide become 0.
class DenseCholesky {
 public:
  DenseCholesky() = default;
  // Row by row, `size` squared numbers.
  DenseCholesky(std::vector<double> matrix, size_t size);
  void solve(std::vector<double>& x) const;

 private:
  size_t size_ = 0;
  std::vector<double> factor_;  // the lower triangle; a row's diagonal is one over the pivot's root, or 0
};

}  // namespace ombre::fea
