// Linear elasticity on equal bricks.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "fea/model.h"

namespace ombre::fea {

// What conjugate gradients on bricks are preconditioned with.
enum class Solver : uint8_t {
  multigrid,
  direct,     // a factorisation (direct.h)
  automatic,  // multigrid at first; a factorisation, where multigrid is slow and that is expected to be quicker and
              // fits
};

// A factorisation that was made or is about to be.
struct DirectUse {
  double operations = 0, memory_bytes = 0;
  double disk_bytes = 0;  // 0: the factor is in memory
};

struct SolveOptions {
  double tolerance = 1e-8;  // of the residual, in the norm of the right side
  size_t most_iterations = 20000;
  int threads = 0;  // 0: all cores
  Solver solver = Solver::multigrid;
  double memory_bytes = 8e9;  // that a factorisation may take
  std::function<void(const DirectUse&)> announce = {};
};

struct Solution {
  std::vector<Vec3> displacement_mm;  // of nodes
  std::vector<std::array<double, 6>>
      stress_mpa;                             // in the middle of what is inside of each brick: xx, yy, zz, xy, yz, zx
  std::vector<std::array<double, 6>> strain;  // engineering shear
  std::vector<Prescribed> reactions_n;        // at what is held, in the order of the conditions
  size_t iterations = 0;
  std::optional<DirectUse> direct;
  double residual = 0;   // of the last iteration, in the norm of the right side
  double energy_mj = 0;  // N mm: the strain energy
};

double von_mises(const std::array<double, 6>& stress);

// Trilinear bricks whose change of volume is the mean of the brick's (B-bar: Hughes, 1980), as Abaqus' C3D8 has it, so
// that nearly incompressible materials do not lock. By conjugate gradients, without a matrix unless one is factorised
// (Solver). The same bits with any number of threads. Progress counts thousandths of the way to the tolerance. Throws
// Error when it does not converge, and Cancelled.
Solution solve(const Model& model, const Conditions& conditions, const SolveOptions& options,
               Progress* progress = nullptr, const StopFlag* stop = nullptr);

// The memory that solve() takes, about.
double solve_bytes(const Bricks& bricks);

}  // namespace ombre::fea
