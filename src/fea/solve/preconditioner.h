// The interface of preconditioners of conjugate gradients.
#pragma once

#include "fea/solve/brick_operator.h"

namespace ombre::fea {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  // Computes approximate displacements for these forces, by a symmetric and positive operator. Throws Cancelled.
  virtual void apply(const Vector& forces, Vector& displacements) = 0;
};

}  // namespace ombre::fea
