// Solves the equations of bricks.
#pragma once

#include <cstdint>

#include "base/progress.h"
#include "base/stopwatch.h"
#include "fea/elastic.h"
#include "fea/multigrid.h"

namespace ombre::fea {

struct Convergence {
  size_t iterations = 0;
  double residual = 0;  // of the last iteration, in the norm of the first
};

// Conjugate gradients (Hestenes and Stiefel, 1952) with a multigrid preconditioner, which is made once for several
// right sides. What is passed must live as long.
class Gradients {
 public:
  Gradients(const BrickOperator& stiffness, const SolveOptions& options, Progress* progress, const StopFlag* stop)
      : stiffness_(stiffness), options_(options), progress_(progress), stop_(stop), multigrid_(stiffness, stop) {}

  // Adds to the displacements `x` what balances the forces `residual`, which are 0 where it is held. Throws Error when
  // it does not converge, and Cancelled.
  Convergence run(Vector residual, Vector& x);

 private:
  void tell(double residual);

  const BrickOperator& stiffness_;
  const SolveOptions& options_;
  Progress* progress_;
  const StopFlag* stop_;
  Multigrid multigrid_;
  Stopwatch watch_;
  uint64_t farthest_ = 0;
};

}  // namespace ombre::fea
