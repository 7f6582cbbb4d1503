#include "fea/dense_cholesky.h"

#include <cmath>

namespace ombre::fea {

DenseCholesky::DenseCholesky(std::vector<double> matrix, size_t size) : size_(size), factor_(std::move(matrix)) {
  constexpr double least_pivot = 1e-12;  // of the diagonal
  for (size_t i = 0; i < size; ++i) {
    double* const row = factor_.data() + i * size;
    const double diagonal = row[i];
    double pivot = diagonal;
    for (size_t j = 0; j <= i; ++j) {
      const double* const other = factor_.data() + j * size;
      double sum = row[j];
      for (size_t k = 0; k < j; ++k) sum -= row[k] * other[k];
      if (j < i)
        row[j] = sum * other[j];
      else
        pivot = sum;
    }
    row[i] = pivot > least_pivot * diagonal ? 1 / std::sqrt(pivot) : 0;
  }
}

void DenseCholesky::solve(std::vector<double>& x) const {
  for (size_t i = 0; i < size_; ++i) {
    const double* const row = factor_.data() + i * size_;
    for (size_t k = 0; k < i; ++k) x[i] -= row[k] * x[k];
    x[i] *= row[i];
  }
  for (size_t i = size_; i-- > 0;) {
    const double* const row = factor_.data() + i * size_;
    x[i] *= row[i];
    for (size_t k = 0; k < i; ++k) x[k] -= row[k] * x[i];
  }
}

}  // namespace ombre::fea
