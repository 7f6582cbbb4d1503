// Finds where to put a share of the material so that a solid is stiffest under its loads.
#pragma once

#include <functional>
#include <vector>

#include "base/progress.h"
#include "fea/model.h"

namespace ombre::optimise {

struct TopologyOptions {
  double volume_fraction = 0.5;  // of the bricks' volume
  double radius_mm = 1.5;        // of the filter: thinner members do not form
  double penalty = 3;            // the modulus goes with this power of the density
  double least = 1e-9;           // of the modulus, where the density is 0
  double move = 0.2;             // the most that a density changes in a step
  double change = 0.01;          // of all densities, at which it ends
  double tolerance = 1e-6;       // of the forces, in the norm of the loads
  size_t steps = 200;            // at most
  // How steep the projection becomes that makes densities 0 or 1; 0: none. It begins with 1 and doubles every
  // `projection_steps` steps, or when densities hardly change (Wang, Lazarov and Sigmund, 2011, about a half).
  double projection = 0;
  size_t projection_steps = 30;
  int threads = 0;
};

struct TopologyStep {
  size_t number = 1;
  double compliance = 0;  // N mm, of the densities before the step
  double volume_fraction = 0, change = 0;
  double greyness = 0;  // the mean of 4 density (1 - density): 0 where all are 0 or 1
};

struct Topology {
  std::vector<float> density;  // of bricks, 0 to 1
  std::vector<TopologyStep> steps;
};

// Least compliance by SIMP with optimality criteria and a filter of densities (Andreassen,
// Clausen, Schevenels, Lazarov and Sigmund: Efficient topology optimization in MATLAB using 88 lines of code, 2011), on
// the fea's bricks, each with its own modulus. Displacements must be held at 0. The same bits with any number of
// threads. `told` gets each step. Throws Error when equations do not converge, and Cancelled.
Topology find_topology(const fea::Model& model, const fea::Conditions& conditions, const TopologyOptions& options,
                       const std::function<void(const TopologyStep&)>& told = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::optimise
