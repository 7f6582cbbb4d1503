#include "fea/solve/solvers.h"

#include <algorithm>

#include "base/system/assert.h"
#include "fea/solve/multigrid.h"

namespace ombre::fea {
namespace {

template <class Kind>
std::unique_ptr<Preconditioner> make(const BrickOperator& stiffness, const StopFlag* stop) {
  return std::make_unique<Kind>(stiffness, stop);
}

}  // namespace

const std::vector<Solver>& all_solvers() {
  static const std::vector<Solver> rows{
      {"auto", "begins with multigrid on bricks, and factorises the equations if that is slow", make<Multigrid>, true},
      {"multigrid", "conjugate gradients with multigrid", make<Multigrid>},
      {"direct", "factorises the equations"},
  };
  return rows;
}

const Solver& solver_of(const std::string& name) {
  const auto found = std::ranges::find(all_solvers(), name, &Solver::name);
  ASSERT(found != all_solvers().end());
  return *found;
}

}  // namespace ombre::fea
