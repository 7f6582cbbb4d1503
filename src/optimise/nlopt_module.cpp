// Methods of NLopt, which ask for one point after the other.
#include <nlopt.h>

#include <exception>
#include <memory>

#include "optimise/search_calls.h"

namespace ombre::optimise {
namespace {

constexpr double first_step = 0.25;  // step of coordinates, which go from 0 to 1
// Value of a point that could not be measured, as a multiple of the first point's value.
constexpr double penalty = 10;

// Shares the outcome of a point between NLopt's separate calls for objective and constraints.
class Values {
 public:
  Values(const Problem& problem, nlopt_opt optimiser) : problem_(problem), optimiser_(optimiser) {}

  double objective(const double* x) {
    const Outcome& outcome = at(x);
    const double value = outcome.failed ? worst_ + penalty * scale_ : outcome.objectives.front();
    return value / scale_ + (adds_violations_ ? penalty * 1e3 * (outcome.failed ? 1 : outcome.violation()) : 0);
  }
  void excesses(const double* x, double* result) {
    const Outcome& outcome = at(x);
    for (size_t n = 0; n < problem_.constraints; ++n) result[n] = outcome.failed ? 1 : outcome.excesses[n];
  }
  // Adds violations to the objective, for methods without constraints.
  void add_violations() { adds_violations_ = true; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  const Outcome& at(const double* x) {
    const Point point(x, x + problem_.start.size());
    if (point == point_ || thrown_) return outcome_;
    try {
      outcome_ = problem_.evaluate({point}).front();
      point_ = point;
      learn();
    } catch (...) {  // exceptions must not pass through NLopt's frames, which are C
      thrown_ = std::current_exception();
      outcome_.failed = true;
      nlopt_force_stop(optimiser_);
    }
    return outcome_;
  }

  void learn() {
    if (outcome_.failed) return;
    const double value = outcome_.objectives.front();
    if (!known_ && value != 0) scale_ = value < 0 ? -value : value;
    worst_ = known_ ? std::max(worst_, value) : value;
    known_ = true;
  }

  const Problem& problem_;
  nlopt_opt optimiser_;
  Point point_;
  Outcome outcome_{true, {}, {}};
  double scale_ = 1, worst_ = 0;
  bool known_ = false, adds_violations_ = false;
  std::exception_ptr thrown_;
};

double objective_of(unsigned, const double* x, double*, void* values) {
  return static_cast<Values*>(values)->objective(x);
}

void excesses_of(unsigned, double* result, unsigned, const double* x, double*, void* values) {
  static_cast<Values*>(values)->excesses(x, result);
}

nlopt_algorithm algorithm_of(const std::string& name) {
  if (name == "bobyqa") return NLOPT_LN_BOBYQA;
  return name == "direct" ? NLOPT_GN_DIRECT_L : NLOPT_LN_COBYLA;
}

void run_nlopt(const Problem& problem, const SearchOptions& options) {
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
      nlopt_create(algorithm_of(options.method), static_cast<unsigned>(problem.start.size())), nlopt_destroy);
  Values values(problem, optimiser.get());
  nlopt_set_lower_bounds1(optimiser.get(), 0);
  nlopt_set_upper_bounds1(optimiser.get(), 1);
  nlopt_set_initial_step1(optimiser.get(), first_step);
  nlopt_set_xtol_abs1(optimiser.get(), options.tolerance);
  nlopt_set_maxeval(optimiser.get(), static_cast<int>(options.evaluations));
  nlopt_set_min_objective(optimiser.get(), objective_of, &values);
  if (options.method == "direct") {
    values.add_violations();
  } else if (problem.constraints > 0) {
    const std::vector<double> tolerances(problem.constraints, 1e-8);
    nlopt_add_inequality_mconstraint(optimiser.get(), static_cast<unsigned>(problem.constraints), excesses_of, &values,
                                     tolerances.data());
  }
  Point x = problem.start;
  double value = 0;
  // The return value is ignored: the evaluations hold the result, and the status only says why it stopped.
  nlopt_optimize(optimiser.get(), x.data(), &value);
  values.rethrow();
}

}  // namespace
}  // namespace ombre::optimise

extern "C" void ombre_search_nlopt(const ombre::optimise::Problem* problem,
                                   const ombre::optimise::SearchOptions* options) {
  ombre::optimise::run_nlopt(*problem, *options);
}
