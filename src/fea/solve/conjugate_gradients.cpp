#include "fea/solve/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "base/text/text.h"
#include "fea/solve/direct.h"
#include "fea/solve/solvers.h"

namespace ombre::fea {
namespace {

// Number of iterations after which the remaining ones with multigrid are estimated; if more than this remain, multigrid
// counts as slow.
constexpr size_t between_judgements = 40;
constexpr double slow = 100;
// Cost of a brick's part of an iteration with multigrid, in operations of a factorisation: measured 100,000 on a
// processor with wide vectors, less elsewhere.
constexpr double operations_of_brick = 5e4;
// Remaining work, in bricks times iterations, below which no quicker way is looked for; about a second.
constexpr double worth_looking_at = 1e6;

[[noreturn]] void fail_to_converge(const Convergence& solution, bool is_conduction) {
  const std::string message = "the equations did not converge: after " + format_count(solution.iterations) +
                              " iterations the " + (is_conduction ? "flows" : "forces") + " are still off by " +
                              format_rounded(solution.residual, 2) + " of the loads; ";
  if (is_conduction) throw Error(Code::not_solved, message + "conductivities differ too much: choose smaller bricks");
  throw Error(Code::not_solved,
              message + "parts that hang together at an edge or a corner may turn about it, or moduli differ " +
                  "too much: choose smaller bricks, or support more of the part");
}

// Returns a use with the factor in memory if it fits, else with the factor on disk; nothing if that does not fit
// either.
std::optional<DirectUse> use_of(const FactorisationCost& cost, double memory_bytes) {
  if (cost.bytes <= memory_bytes) return DirectUse{cost.operations, cost.bytes, 0};
  if (cost.bytes_on_disk > memory_bytes) return std::nullopt;
  return DirectUse{cost.operations, cost.bytes_on_disk, cost.factor_bytes};
}

[[noreturn]] void refuse_memory(double bytes, double allowed) {
  throw Error(Code::memory, "factorising the equations takes about " + format_bytes(bytes) +
                                " of memory, more than the " + format_bytes(allowed) +
                                " allowed; solve by multigrid, choose larger bricks, or allow more memory");
}

}  // namespace

Gradients::Gradients(const BrickOperator& stiffness, const SolveOptions& options, Progress* progress,
                     const StopFlag* stop)
    : stiffness_(stiffness),
      options_(options),
      progress_(progress),
      stop_(stop),
      may_change_(solver_of(options.solver).may_factorise) {
  iterate();
  if (!preconditioner_) factorise();
}

Gradients::~Gradients() = default;

// Makes the preconditioner, if the solver has one.
void Gradients::iterate() {
  if (const auto make = solver_of(options_.solver).make) preconditioner_ = make(stiffness_, stop_);
}

void Gradients::factorise() {
  if (!can_factorise(stiffness_))
    throw Error(Code::not_solved,
                has_factorisations()
                    ? "the equations cannot be factorised, since a brick touches itself; solve by multigrid"
                    : without_factorisations());
  if (const double least = element_matrix_bytes(stiffness_); least > options_.memory_bytes)
    refuse_memory(least, options_.memory_bytes);
  prepared_ = std::make_unique<Factorisation>(stiffness_, progress_, stop_);
  const auto use = use_of(prepared_->cost(), options_.memory_bytes);
  if (!use) refuse_memory(prepared_->cost().bytes_on_disk, options_.memory_bytes);
  if (!take(*use))
    throw Error(Code::not_solved,
                "the equations could not be factorised, in double precision either, or memory is short for that; solve "
                "by multigrid, or allow more memory");
}

// Returns the number of remaining iterations if the residual goes on to fall as it has since the last estimate.
double Gradients::iterations_left(double residual, double last) const {
  if (!(residual < last)) return static_cast<double>(options_.most_iterations);
  return between_judgements * std::log(options_.tolerance / residual) / std::log(residual / last);
}

// Changes to a factorisation if it is quicker than this number of iterations with multigrid.
bool Gradients::change(double iterations) {
  const double left = iterations * static_cast<double>(stiffness_.bricks().count());
  if (iterations < slow || left < worth_looking_at) return false;
  if (!prepared_) {
    may_change_ = can_factorise(stiffness_) && element_matrix_bytes(stiffness_) <= options_.memory_bytes;
    if (!may_change_) return false;
    prepared_ = std::make_unique<Factorisation>(stiffness_, progress_, stop_);
  }
  const auto use = use_of(prepared_->cost(), options_.memory_bytes);
  may_change_ = use.has_value();
  if (!use || use->operations > operations_of_brick * left) return false;
  may_change_ = false;
  return take(*use);
}

// Factorises; returns false if that is not possible, and multigrid goes on.
bool Gradients::take(const DirectUse& use) {
  if (options_.announce) options_.announce(use);
  is_single_ = prepared_->factorise(use.disk_bytes > 0, Precision::single);
  if (!is_single_) return take_twofold();
  direct_ = use;
  preconditioner_ = std::move(prepared_);
  return true;
}

// A factor that helps little has lost too many digits.
bool Gradients::leave_single() {
  preconditioner_.reset();
  direct_.reset();
  prepared_ = std::make_unique<Factorisation>(stiffness_, progress_, stop_);
  if (!take_twofold()) iterate();
  return true;
}

bool Gradients::take_twofold() {
  is_single_ = false;
  FactorisationCost cost = prepared_->cost();
  cost.bytes *= 2, cost.bytes_on_disk *= 2, cost.factor_bytes *= 2;
  const auto use = use_of(cost, options_.memory_bytes);
  if (use && options_.announce) options_.announce(*use);
  if (!use || !prepared_->factorise(use->disk_bytes > 0, Precision::twofold)) {
    prepared_.reset();
    return false;
  }
  direct_ = use;
  preconditioner_ = std::move(prepared_);
  return true;
}

Convergence Gradients::run(Vector residual, Vector& x) {
  Convergence solution;
  const int threads = stiffness_.threads();
  const double scale = std::sqrt(dot(residual, residual, threads));
  if (!(scale > 0)) return solution;
  Vector z, p, q;
  preconditioner_->apply(residual, z);
  p = z;
  double rz = dot(residual, z, threads), last_judged = 1;
  for (solution.iterations = 1;; ++solution.iterations) {
    if (stop_ && stop_->requested()) throw Cancelled();
    stiffness_.forces(p, q);
    const double alpha = rz / dot(p, q, threads);
    for_pieces(x.size(), threads, [&](size_t begin, size_t end) {
      for (size_t n = begin; n < end; ++n) {
        x[n] += alpha * p[n];
        residual[n] -= alpha * q[n];
      }
    });
    solution.residual = std::sqrt(dot(residual, residual, threads)) / scale;
    tell(solution.residual);
    solution.direct = direct_;
    if (solution.residual <= options_.tolerance) return solution;
    if (!std::isfinite(solution.residual) || solution.iterations >= options_.most_iterations)
      fail_to_converge(solution, stiffness_.unknowns() == 1);
    bool has_changed = false;
    if (solution.iterations % between_judgements == 0) {
      if (may_change_)
        has_changed = change(iterations_left(solution.residual, last_judged));
      else if (is_single_)
        has_changed = leave_single();
      last_judged = solution.residual;
    }
    preconditioner_->apply(residual, z);
    const double next = dot(residual, z, threads), beta = has_changed ? 0 : next / rz;
    rz = next;
    for_pieces(x.size(), threads, [&](size_t begin, size_t end) {
      for (size_t n = begin; n < end; ++n) p[n] = z[n] + beta * p[n];
    });
  }
}

void Gradients::tell(double residual) {
  constexpr double parts = 1000;
  if (!progress_ || !(residual > 0)) return;
  const double way = std::clamp(std::log(residual) / std::log(options_.tolerance), 0.0, 1.0);
  farthest_ = std::max(farthest_, static_cast<uint64_t>(parts * way));
  HowFar how_far{farthest_, static_cast<uint64_t>(parts)};
  if (farthest_ > 0) how_far.seconds_left = watch_.seconds() * (parts / static_cast<double>(farthest_) - 1);
  progress_->update(how_far);
}

}  // namespace ombre::fea
