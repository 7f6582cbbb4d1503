// What conjugate gradients have in place of the inverse of their matrix.
#pragma once

#include "fea/solve/brick_operator.h"

namespace ombre::fea {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  // About the displacements that these forces make: a symmetric and positive operator. Throws Cancelled.
  virtual void apply(const Vector& forces, Vector& displacements) = 0;
};

}  // namespace ombre::fea
