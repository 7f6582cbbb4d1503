// Solves the equations of bricks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/system/progress.h"
#include "base/system/stopwatch.h"
#include "fea/solve/preconditioner.h"
#include "fea/solve/solve_options.h"

namespace ombre::fea {

class Factorisation;

struct Convergence {
  size_t iterations = 0;
  std::optional<DirectUse> direct;
  double residual = 0;  // residual of the last iteration, in the norm of the first
};

// Conjugate gradients (Hestenes and Stiefel, 1952) with a preconditioner, which is made once for several right sides.
// All arguments must outlive the object.
class Gradients {
 public:
  // Throws Error when a requested factorisation does not fit, and Cancelled.
  Gradients(const BrickOperator& stiffness, const SolveOptions& options, Progress* progress, const StopFlag* stop);

  ~Gradients();

  // Adds to `x` the displacements that balance the forces `residual`, which are 0 at held unknowns. Throws Error when
  // it does not converge, and Cancelled.
  Convergence run(Vector residual, Vector& x);

 private:
  void tell(double residual);
  void iterate();
  void factorise();
  double iterations_left(double residual, double last) const;
  bool change(double iterations);
  bool take(const DirectUse& use);
  bool take_twofold();
  bool leave_single();

  const BrickOperator& stiffness_;
  const SolveOptions& options_;
  Progress* progress_;
  const StopFlag* stop_;
  std::unique_ptr<Preconditioner> preconditioner_;
  std::unique_ptr<Factorisation> prepared_;  // ordered and counted, but not factorised
  std::optional<DirectUse> direct_;
  bool may_change_ = false, is_single_ = false;
  Stopwatch watch_;
  uint64_t farthest_ = 0;
};

}  // namespace ombre::fea
