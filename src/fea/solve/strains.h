// Computes strains of displacements, and their stresses.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/math/vec.h"

namespace ombre::fea {

// xx, yy, zz, xy, yz, zx; shear strains are engineering ones.
using Tensor = std::array<double, 6>;

// Returns the strain at a place of an element with these gradients (1/mm) of its nodes' shape functions;
// `displacements_mm` are x, y, z of node 0, and so on.
inline Tensor strain_of(std::span<const uint32_t> nodes, std::span<const Vec3> gradients,
                        std::span<const double> displacements_mm) {
  Tensor strain{};
  for (size_t n = 0; n < nodes.size(); ++n) {
    const double* const u = displacements_mm.data() + 3 * size_t{nodes[n]};
    const Vec3 g = gradients[n];
    strain[0] += g.x * u[0];
    strain[1] += g.y * u[1];
    strain[2] += g.z * u[2];
    strain[3] += g.y * u[0] + g.x * u[1];
    strain[4] += g.z * u[1] + g.y * u[2];
    strain[5] += g.z * u[0] + g.x * u[2];
  }
  return strain;
}

// Applies Hooke's law; moduli and stresses are in MPa.
inline Tensor stress_of(const Tensor& strain, double shear_mpa, double bulk_mpa) {
  const double dilation = strain[0] + strain[1] + strain[2];
  Tensor stress{};
  for (size_t n = 0; n < 3; ++n) {
    stress[n] = 2 * shear_mpa * (strain[n] - dilation / 3) + bulk_mpa * dilation;
    stress[3 + n] = shear_mpa * strain[3 + n];
  }
  return stress;
}

}  // namespace ombre::fea
