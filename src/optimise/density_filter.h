// A filter that takes means of values over neighbouring bricks, with weights that fall with the distance (Bruns and
// Tortorelli, 2001).
#pragma once

#include <vector>

#include "fea/solve/brick_operator.h"

namespace ombre::optimise {

class DensityFilter {
 public:
  // `bricks` must outlive the filter.
  DensityFilter(const fea::Bricks& bricks, double radius_mm, int threads);

  // Returns the mean around each brick.
  fea::Vector apply(const fea::Vector& values) const;
  // Returns the gradient by the unfiltered values of a function, given its gradient by the filtered ones.
  fea::Vector apply_transposed(const fea::Vector& gradient) const;

 private:
  struct Neighbour {
    fea::Cell offset;
    double weight;
  };

  fea::Vector sums(const fea::Vector& values) const;
  int64_t place(const fea::Cell& cell) const;

  const fea::Bricks& bricks_;
  int threads_;
  fea::Cell low_{}, count_{};
  std::vector<int32_t> brick_at_;  // number of the brick in each cell of a grid around all bricks; -1: none
  std::vector<Neighbour> neighbours_;
  fea::Vector weights_;  // sum of the weights of each brick
};

}  // namespace ombre::optimise
