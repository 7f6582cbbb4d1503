#include "fea/brick_stiffness.h"

#include <cmath>

#include "fea/bricks.h"

namespace ombre::fea {
namespace {

using Strain = std::array<double, 6>;  // xx, yy, zz, and the engineering shears xy, yz, zx

// The strain that a displacement of one along the axis gives, less its mean of xx, yy and zz.
Strain deviator_of(Vec3 gradient, int axis) {
  Strain strain{};
  strain[static_cast<size_t>(axis)] = gradient[axis];
  const double mean = gradient[axis] / 3;
  for (size_t n = 0; n < 3; ++n) strain[n] -= mean;
  if (axis == 0) strain[3] = gradient.y, strain[5] = gradient.z;
  if (axis == 1) strain[3] = gradient.x, strain[4] = gradient.z;
  if (axis == 2) strain[4] = gradient.y, strain[5] = gradient.x;
  return strain;
}

// Twice the energy's density of two deviators for a shear modulus of one.
double product(const Strain& a, const Strain& b) {
  return 2 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

}  // namespace

std::array<Vec3, 8> shape_gradients(Vec3 size_mm, Vec3 at) {
  std::array<Vec3, 8> gradients;
  for (size_t c = 0; c < 8; ++c) {
    Vec3 value, slope;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_upper = brick_corners[c][static_cast<size_t>(axis)] == 1;
      value[axis] = is_upper ? at[axis] : 1 - at[axis];
      slope[axis] = (is_upper ? 1 : -1) / size_mm[axis];
    }
    gradients[c] = {slope.x * value.y * value.z, value.x * slope.y * value.z, value.x * value.y * slope.z};
  }
  return gradients;
}

BrickStiffness brick_stiffness(Vec3 size_mm) {
  BrickStiffness stiffness;
  stiffness.volume_mm3 = size_mm.x * size_mm.y * size_mm.z;
  const double offset = 0.5 / std::sqrt(3.0);  // of Gauss' points from the middle
  for (const Cell& corner : brick_corners) {
    const auto along = [&](size_t axis) { return 0.5 + (corner[axis] == 1 ? offset : -offset); };
    const auto gradients = shape_gradients(size_mm, {along(0), along(1), along(2)});
    const double weight = stiffness.volume_mm3 / 8;
    std::array<Strain, 24> strains;
    for (size_t n = 0; n < 24; ++n) {
      strains[n] = deviator_of(gradients[n / 3], static_cast<int>(n % 3));
      stiffness.dilation[n] += gradients[n / 3][static_cast<int>(n % 3)] / 8;
    }
    for (size_t a = 0; a < 24; ++a)
      for (size_t b = 0; b < 24; ++b) stiffness.shear[a][b] += weight * product(strains[a], strains[b]);
  }
  return stiffness;
}

void BrickStiffness::add_forces(double shear_mpa, double bulk_mpa, const BrickVector& u, BrickVector& forces) const {
  double divergence = 0;
  for (size_t n = 0; n < 24; ++n) divergence += dilation[n] * u[n];
  const double pressure = bulk_mpa * volume_mm3 * divergence;
  BrickVector sum{};
  for (size_t a = 0; a < 24; ++a)
    for (size_t b = 0; b < 24; ++b) sum[b] += shear[a][b] * u[a];
  for (size_t n = 0; n < 24; ++n) forces[n] += shear_mpa * sum[n] + pressure * dilation[n];
}

}  // namespace ombre::fea
