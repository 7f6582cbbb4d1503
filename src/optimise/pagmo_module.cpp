// Methods of pagmo, which ask for a population of points at once.
#include <cmath>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "optimise/search_calls.h"

namespace ombre::optimise {
namespace {

// Value of points that violate constraints, to which the violation is added, so that they are worse than all others
// (Deb, 2000).
constexpr double infeasible = 1e12;
constexpr double unknown_violation = 1e6;

// The problem in the form that pagmo calls. pagmo copies the adapter, not the problem.
struct Adapter {
  const Problem* problem = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    return fitness_of(problem->evaluate({x}).front());
  }

  pagmo::vector_double batch_fitness(const pagmo::vector_double& all) const {
    const size_t variables = problem->start.size();
    std::vector<Point> points;
    for (auto from = all.begin(); from != all.end(); from += static_cast<std::ptrdiff_t>(variables))
      points.emplace_back(from, from + static_cast<std::ptrdiff_t>(variables));
    pagmo::vector_double fitnesses;
    for (const Outcome& outcome : problem->evaluate(points))
      for (const double value : fitness_of(outcome)) fitnesses.push_back(value);
    return fitnesses;
  }

  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const size_t variables = problem ? problem->start.size() : 1;
    return {pagmo::vector_double(variables, 0), pagmo::vector_double(variables, 1)};
  }
  pagmo::vector_double::size_type get_nobj() const { return problem ? problem->objectives : 1; }

  template <class Archive>
  void serialize(Archive&, unsigned) {}  // pagmo requires it; nothing is stored

 private:
  pagmo::vector_double fitness_of(const Outcome& outcome) const {
    const double violation = outcome.failed ? unknown_violation : outcome.violation();
    if (violation > 0) return pagmo::vector_double(problem->objectives, infeasible * (1 + violation));
    return outcome.objectives;
  }
};

void run_pagmo(const Problem& problem, const SearchOptions& options) {
  // NSGA-II pairs points twice, so populations are multiples of four.
  const size_t population_size = std::max<size_t>(8, (options.population + 3) / 4 * 4);
  const auto generations = static_cast<unsigned>(
      options.evaluations > population_size ? (options.evaluations - population_size) / population_size : 0);
  pagmo::population population(pagmo::problem(Adapter{&problem}), pagmo::bfe{}, population_size - 1, options.seed);
  population.push_back(problem.start);
  if (generations == 0) return;
  if (options.method == "cmaes") {
    // CMA-ES ends at differences of 1e-6 in values and coordinates.
    pagmo::algorithm(pagmo::cmaes(generations, -1, -1, -1, -1, 0.3, 1e-6, 1e-6, false, true, options.seed))
        .evolve(population);
    return;
  }
  pagmo::nsga2 method(generations, 0.95, 10, 1.0 / static_cast<double>(problem.start.size()), 50, options.seed);
  method.set_bfe(pagmo::bfe{});
  pagmo::algorithm(method).evolve(population);
}

}  // namespace
}  // namespace ombre::optimise

extern "C" void ombre_search_pagmo(const ombre::optimise::Problem* problem,
                                   const ombre::optimise::SearchOptions* options) {
  ombre::optimise::run_pagmo(*problem, *options);
}
