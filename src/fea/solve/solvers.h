// The solvers of equations of bricks, as a table.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "fea/solve/preconditioner.h"

namespace ombre::fea {

struct Solver {
  std::string name, help;  // help says what it does: "factorises the equations"
  // Makes a preconditioner of conjugate gradients; null: the equations are factorised instead. It may throw Cancelled.
  std::unique_ptr<Preconditioner> (*make)(const BrickOperator& stiffness, const StopFlag* stop) = nullptr;
  bool may_factorise = false;  // changes to a factorisation if that fits and is expected to be quicker
};

// Rows of solvers; the first is the default.
const std::vector<Solver>& all_solvers();
// Returns the solver of this name, which must be a row's.
const Solver& solver_of(const std::string& name);

}  // namespace ombre::fea
