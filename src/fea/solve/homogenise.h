// The effective stiffness of a periodic cell of bricks, or of a periodic box of a random material.
#pragma once

#include <array>
#include <optional>

#include "fea/solve/elastic.h"

namespace ombre::fea {

// Maps strains to stresses, each as xx, yy, zz, xy, yz, zx with engineering shear (Voigt's notation).
using Stiffness = std::array<std::array<double, 6>, 6>;

struct Homogenised {
  Stiffness stiffness_mpa{};
  Stiffness voigt_mpa{};   // mean of the stiffnesses: no arrangement is stiffer
  Stiffness reuss_mpa{};   // inverse of the mean of the compliances: none is softer; 0 if there is void
  double solid_share = 0;  // share of the cell's volume
  size_t iterations = 0;   // sum over all six load cases
};

// Homogenises a cell. The bricks repeat after `model.bricks.period`, which is set along all axes; cells without a brick
// are void. There are six load cases with periodic displacements (Suquet, 1987; Michel, Moulinec and Suquet, 1999,
// section 2), which progress counts. Throws Error when one does not converge, and Cancelled.
Homogenised homogenise(const Model& model, const SolveOptions& options, Progress* progress = nullptr,
                       const StopFlag* stop = nullptr);

// The engineering constants of a stiffness.
struct EngineeringConstants {
  std::array<double, 3> modulus_mpa{};        // along x, y, z
  std::array<double, 3> shear_modulus_mpa{};  // xy, yz, zx
  std::array<double, 3> poissons_ratio{};     // xy, yz, zx: -strain along the second, pulled along the first
  // Means over all directions, after Voigt, Reuss and Hill, and the universal anisotropy: 0 if isotropic (Ranganathan
  // and Ostoja-Starzewski, 2008).
  double bulk_modulus_mpa = 0, mean_shear_modulus_mpa = 0;
  double universal_anisotropy = 0;
};

// Returns nothing if the material carries no load in some direction.
std::optional<EngineeringConstants> constants_of(const Stiffness& stiffness);

// Returns Young's modulus along a direction, MPa; 0 if no load is carried.
double modulus_along(const Stiffness& stiffness, Vec3 direction);

// Draws polar diagrams of Young's modulus in the planes xy, yz and zx, as an SVG picture.
std::string stiffness_chart(const Stiffness& stiffness, const std::string& title);

}  // namespace ombre::fea
