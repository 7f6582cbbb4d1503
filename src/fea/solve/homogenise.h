// The effective stiffness of a periodic cell of bricks, or of a box of a material that repeats at random.
#pragma once

#include <array>
#include <optional>

#include "fea/solve/elastic.h"

namespace ombre::fea {

// Maps strains to stresses, each as xx, yy, zz, xy, yz, zx with engineering shear (Voigt's notation).
using Stiffness = std::array<std::array<double, 6>, 6>;

struct Homogenised {
  Stiffness stiffness_mpa{};
  Stiffness voigt_mpa{};   // the mean of the stiffnesses: no arrangement is stiffer
  Stiffness reuss_mpa{};   // the inverse of the mean of the compliances: none is softer; 0 where there is void
  double solid_share = 0;  // of the cell's volume
  size_t iterations = 0;   // of all six load cases
};

// The bricks repeat after `model.bricks.period`, which is set along all axes; cells without a brick are void. Six
// load cases with periodic displacements (Suquet, 1987; Michel, Moulinec and Suquet, 1999, section 2). Progress counts
// load cases. Throws Error when one does not converge, and Cancelled.
Homogenised homogenise(const Model& model, const SolveOptions& options, Progress* progress = nullptr,
                       const StopFlag* stop = nullptr);

// The numbers that engineers derive from a stiffness.
struct EngineeringConstants {
  std::array<double, 3> modulus_mpa{};        // along x, y, z
  std::array<double, 3> shear_modulus_mpa{};  // xy, yz, zx
  std::array<double, 3> poissons_ratio{};     // xy, yz, zx: -strain along the second, pulled along the first
  // Means over all directions, after Voigt, Reuss and Hill, and how far the material is from isotropic: 0 if it is
  // (Ranganathan and Ostoja-Starzewski, 2008).
  double bulk_modulus_mpa = 0, mean_shear_modulus_mpa = 0;
  double universal_anisotropy = 0;
};

// Nothing where the material holds no load in some direction.
std::optional<EngineeringConstants> constants_of(const Stiffness& stiffness);

// Young's modulus along a direction, MPa; 0 where no load is held.
double modulus_along(const Stiffness& stiffness, Vec3 direction);

// Polar diagrams of Young's modulus in the planes xy, yz and zx, as an SVG picture.
std::string stiffness_chart(const Stiffness& stiffness, const std::string& title);

}  // namespace ombre::fea
