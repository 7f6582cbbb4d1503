// Finds the distribution of a share of the material with which a solid is stiffest under its loads.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/system/progress.h"
#include "fea/model/model.h"

namespace ombre::optimise {

// A displacement that is minimised or maximised. It is the work that forces whose sum is 1 would do, which is the mean
// of displacements along them.
struct TopologyGoal {
  std::vector<fea::Prescribed> unit_forces;
  bool is_greatest = false;
};

struct TopologyOptions {
  double volume_fraction = 0.5;  // share of the bricks' volume
  double radius_mm = 1.5;        // radius of the filter; thinner members do not form
  double penalty = 3;            // the modulus goes with this power of the density
  double least = 1e-9;           // share of the modulus at density 0
  double move = 0.2;             // greatest change of a density in a step
  double change = 0.01;          // greatest change of all densities at which the search ends
  double tolerance = 1e-6;       // residual of forces, in the norm of the loads
  size_t steps = 200;            // greatest number of steps
  // Steepness of the projection that makes densities 0 or 1; 0: none. It begins with 1 and doubles every
  // `projection_steps` steps, or when densities hardly change (Wang, Lazarov and Sigmund, 2011, about a half).
  double projection = 0;
  size_t projection_steps = 30;
  std::optional<TopologyGoal> goal;  // without a goal the compliance is minimised
  int threads = 0;
};

struct TopologyStep {
  size_t number = 1;
  double compliance = 0;    // N mm, for the densities before the step
  double displacement = 0;  // mm, of the goal, if there is one
  double volume_fraction = 0, change = 0;
  double greyness = 0;  // mean of 4 density (1 - density): 0 if all densities are 0 or 1
};

struct Topology {
  std::vector<float> density;  // density of each brick, 0 to 1
  std::vector<TopologyStep> steps;
};

// Minimises the compliance, or optimises a goal, by SIMP with optimality criteria and a filter of densities
// (Andreassen, Clausen, Schevenels, Lazarov and Sigmund: Efficient topology optimization in MATLAB using 88 lines of
// code, 2011), on bricks of which each has its own modulus. A goal's derivatives come from adjoint displacements under
// its unit forces. If more material would harm the goal, all gains are raised by one number, and steps are damped
// (Bendsoe and Sigmund, Topology Optimization, 2003, 2.3). Prescribed displacements must be 0. The result has the same
// bits with any number of threads. `report` gets each step. Throws Error when equations do not converge or the goal's
// place is held, and Cancelled.
Topology find_topology(const fea::Model& model, const fea::Conditions& conditions, const TopologyOptions& options,
                       const std::function<void(const TopologyStep&)>& report = nullptr,
                       const StopFlag* stop = nullptr);

// The compliance, N mm, or the goal's displacement, mm, of bricks with given densities, and its derivatives by them.
struct TopologySlopes {
  double value = 0;
  std::vector<double> by_density;
};
TopologySlopes topology_slopes(const fea::Model& model, const fea::Conditions& conditions,
                               const TopologyOptions& options, const std::vector<double>& density);

}  // namespace ombre::optimise
