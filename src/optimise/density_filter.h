// Means of values over neighbouring bricks, with weights that fall with the distance (Bruns and Tortorelli, 2001).
#pragma once

#include <vector>

#include "fea/solve/brick_operator.h"

namespace ombre::optimise {

class DensityFilter {
 public:
  // The bricks must live as long.
  DensityFilter(const fea::Bricks& bricks, double radius_mm, int threads);

  // The mean around each brick.
  fea::Vector apply(const fea::Vector& values) const;
  // The gradient by the values of what has this gradient by their means.
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
  std::vector<int32_t> brick_at_;  // in a grid around all bricks; -1: none
  std::vector<Neighbour> neighbours_;
  fea::Vector weights_;  // their sum for each brick
};

}  // namespace ombre::optimise
