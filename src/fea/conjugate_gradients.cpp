#include "fea/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace ombre::fea {
namespace {

[[noreturn]] void fail_to_converge(const Convergence& solution, bool is_conduction) {
  const std::string message = "the equations did not converge: after " + format_count(solution.iterations) +
                              " iterations the " + (is_conduction ? "flows" : "forces") + " are still off by " +
                              format_rounded(solution.residual, 2) + " of the loads; ";
  if (is_conduction) throw Error(message + "conductivities differ too much: choose smaller bricks");
  throw Error(message + "parts that hang together at an edge or a corner may turn about it, or moduli differ " +
              "too much: choose smaller bricks, or support more of the part");
}

}  // namespace

Convergence Gradients::run(Vector residual, Vector& x) {
  Convergence solution;
  const int threads = stiffness_.threads();
  const double scale = std::sqrt(dot(residual, residual, threads));
  if (!(scale > 0)) return solution;
  Vector z, p, q;
  multigrid_.apply(residual, z);
  p = z;
  double rz = dot(residual, z, threads);
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
    if (solution.residual <= options_.tolerance) return solution;
    if (!std::isfinite(solution.residual) || solution.iterations >= options_.most_iterations)
      fail_to_converge(solution, stiffness_.unknowns() == 1);
    multigrid_.apply(residual, z);
    const double next = dot(residual, z, threads), beta = next / rz;
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
