// The stiffness of a brick, for moduli of one.
#pragma once

#include <array>
#include <cstddef>

#include "base/math/vec.h"

namespace ombre::fea {

// Three displacements for each of a brick's nodes: x, y, z of the first, and so on.
using BrickVector = std::array<double, 24>;

// Four numbers that are processed together.
using Four = double __attribute__((vector_size(32)));
using FourVector = std::array<Four, 24>;

// A block of the stiffness in patterns. A brick equals its mirror images, so in sums and differences of its corners
// (Walsh's functions) its stiffness decomposes into eight blocks, each between one pattern of the displacements along
// x, y and z. That takes a quarter of the work.
using PatternBlock = std::array<std::array<double, 3>, 3>;

struct BrickStiffness {
  // Stiffness = shear modulus * shear + bulk modulus * volume * dilation dilation^T.
  std::array<BrickVector, 24> shear{};
  BrickVector dilation{};  // mean divergence of the displacements, 1/mm
  double volume_mm3 = 0;
  std::array<PatternBlock, 8> shear_patterns{};  // `shear` in patterns
  std::array<double, 3> dilation_pattern{};      // `dilation` in the first block; the others have none

  // Computes forces += stiffness for these moduli (MPa) times `u`.
  void add_forces(double shear_mpa, double bulk_mpa, const BrickVector& u, BrickVector& forces) const;
  // Adds the forces of four bricks at once, interleaved; the results have the same bits.
  void add_four(const Four& shear_mpa, const Four& bulk_mpa, const FourVector& u, FourVector& forces) const;
  // Returns entry n of the diagonal of the stiffness.
  double diagonal(double shear_mpa, double bulk_mpa, size_t n) const {
    return shear_mpa * shear[n][n] + bulk_mpa * volume_mm3 * dilation[n] * dilation[n];
  }
};

BrickStiffness brick_stiffness(Vec3 size_mm);

// The conductance of a brick, for a conductivity of one. In patterns of its corners it is diagonal.
struct BrickConductance {
  std::array<double, 8> patterns{};
  double diagonal = 0;

  // Computes flows += conductance times `values`, for each of the brick's nodes.
  void add_flows(double conductivity, const std::array<double, 8>& values, std::array<double, 8>& flows) const;
};

BrickConductance brick_conductance(Vec3 size_mm);

// Returns the gradients of the eight shape functions, 1/mm, at a place in the brick; each coordinate goes from 0 to 1.
std::array<Vec3, 8> shape_gradients(Vec3 size_mm, Vec3 at);

}  // namespace ombre::fea
