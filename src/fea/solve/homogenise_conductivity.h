// The effective conductivity of a periodic cell of bricks.
#pragma once

#include <array>

#include "fea/solve/elastic.h"

namespace ombre::fea {

// Maps gradients of temperature or potential to fluxes against them, in the unit of the sections' conductivity.
using Conductivity = std::array<std::array<double, 3>, 3>;

struct HomogenisedConductivity {
  Conductivity conductivity{};
  double arithmetic_mean = 0;  // Wiener's upper bound (1912): no arrangement conducts better
  double harmonic_mean = 0;    // Wiener's lower bound: none conducts worse; 0 if there is void
  double solid_share = 0;      // share of the cell's volume
  size_t iterations = 0;       // sum over all three load cases
};

// Homogenises a cell. The bricks repeat after `model.bricks.period`, which is set along all axes; cells without a brick
// conduct nothing. The load cases are three uniform gradients, each with a periodic part; progress counts them. Throws
// Error when one does not converge, and Cancelled.
HomogenisedConductivity homogenise_conductivity(const Model& model, const SolveOptions& options,
                                                Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::fea
