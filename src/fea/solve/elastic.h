// Linear elasticity on equal bricks.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/system/progress.h"
#include "fea/model/model.h"
#include "fea/solve/solve_options.h"

namespace ombre::fea {

struct Solution {
  std::vector<Vec3> displacement_mm;              // displacements of nodes
  std::vector<std::array<double, 6>> stress_mpa;  // at the centroid of each brick's part inside: xx, yy, zz, xy, yz, zx
  std::vector<std::array<double, 6>> strain;      // engineering shear
  std::vector<Prescribed> reactions_n;            // forces at held unknowns, in the order of the conditions
  size_t iterations = 0;
  std::optional<DirectUse> direct;
  double residual = 0;   // residual of the last iteration, in the norm of the right side
  double energy_mj = 0;  // strain energy, N mm
};

double von_mises(const std::array<double, 6>& stress);

// Solves with trilinear bricks whose change of volume is the mean over the brick (B-bar: Hughes, 1980), like Abaqus'
// C3D8, so that nearly incompressible materials do not lock. The method is conjugate gradients, without a matrix unless
// one is factorised (Solver). The result has the same bits with any number of threads. Progress counts thousandths of
// the way to the tolerance. Throws Error when it does not converge, and Cancelled.
Solution solve(const Model& model, const Conditions& conditions, const SolveOptions& options,
               Progress* progress = nullptr, const StopFlag* stop = nullptr);

// Returns about the memory in bytes that solve() takes.
double solve_bytes(const Bricks& bricks);

}  // namespace ombre::fea
