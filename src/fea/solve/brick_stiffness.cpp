#include "fea/solve/brick_stiffness.h"

#include <cmath>

#include "fea/model/bricks.h"

namespace ombre::fea {
namespace {

using Strain = std::array<double, 6>;  // xx, yy, zz, and the engineering shears xy, yz, zx

// Returns the strain of a displacement of one along the axis, less its mean of xx, yy and zz.
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

// Returns twice the energy density of two deviators for a shear modulus of one.
double product(const Strain& a, const Strain& b) {
  return 2 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

constexpr std::array<size_t, 3> axis_bits{1, 2, 4};

// Returns a corner's place among patterns: a bit for each axis along which it is the upper one.
constexpr size_t bits_of(size_t corner) {
  const Cell& at = brick_corners[corner];
  const int place = at[0] + 2 * at[1] + 4 * at[2];
  return static_cast<size_t>(place);
}

// Returns -1 if the pattern changes its sign an odd number of times on the way to the corner, else 1.
double sign_of(size_t pattern, size_t bits) {
  const size_t both = pattern & bits;
  return ((both ^ (both >> 1) ^ (both >> 2)) & 1) != 0 ? -1 : 1;
}

// Transforms values at corners to eight times the patterns, and patterns back to corners.
template <class T>
inline void transform(std::array<T, 8>& v) {
  for (size_t n = 0; n < 8; n += 2) {
    const T a = v[n], b = v[n + 1];
    v[n] = a + b;
    v[n + 1] = a - b;
  }
  for (const size_t n : {size_t{0}, size_t{1}, size_t{4}, size_t{5}}) {
    const T a = v[n], b = v[n + 2];
    v[n] = a + b;
    v[n + 2] = a - b;
  }
  for (size_t n = 0; n < 4; ++n) {
    const T a = v[n], b = v[n + 4];
    v[n] = a + b;
    v[n + 4] = a - b;
  }
}

// Returns the pattern of displacements along `axis` that belongs to a block.
size_t pattern_of(size_t block, size_t axis) { return block ^ axis_bits[axis]; }

void find_patterns(BrickStiffness& stiffness) {
  for (size_t block = 0; block < 8; ++block)
    for (size_t a = 0; a < 24; ++a)
      for (size_t b = 0; b < 24; ++b)
        stiffness.shear_patterns[block][a % 3][b % 3] += stiffness.shear[a][b] / 64 *
                                                         sign_of(pattern_of(block, a % 3), bits_of(a / 3)) *
                                                         sign_of(pattern_of(block, b % 3), bits_of(b / 3));
  for (size_t a = 0; a < 24; ++a)
    stiffness.dilation_pattern[a % 3] += stiffness.dilation[a] / 8 * sign_of(pattern_of(0, a % 3), bits_of(a / 3));
}

// Returns the place of a Gauss point along an axis, from 0 to 1.
double gauss_point(const Cell& corner, size_t axis) {
  const double offset = 0.5 / std::sqrt(3.0);  // distance from the middle
  return 0.5 + (corner[axis] == 1 ? offset : -offset);
}

// Works on doubles, or on four of them at once.
template <class T>
inline void add_forces_of(const BrickStiffness& brick, const T& shear_mpa, const T& bulk_mpa,
                          const std::array<T, 24>& u, std::array<T, 24>& forces) {
  std::array<std::array<T, 8>, 3> moved, pushed;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t c = 0; c < 8; ++c) moved[axis][bits_of(c)] = u[3 * c + axis];
    transform(moved[axis]);
  }
  for (size_t block = 0; block < 8; ++block) {
    const T x = moved[0][pattern_of(block, 0)], y = moved[1][pattern_of(block, 1)], z = moved[2][pattern_of(block, 2)];
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto& row = brick.shear_patterns[block][axis];
      pushed[axis][pattern_of(block, axis)] = shear_mpa * (row[0] * x + row[1] * y + row[2] * z);
    }
  }
  T divergence{};
  for (size_t axis = 0; axis < 3; ++axis) divergence += brick.dilation_pattern[axis] * moved[axis][axis_bits[axis]];
  for (size_t axis = 0; axis < 3; ++axis)
    pushed[axis][axis_bits[axis]] += bulk_mpa * brick.volume_mm3 * divergence * brick.dilation_pattern[axis];
  for (size_t axis = 0; axis < 3; ++axis) {
    transform(pushed[axis]);
    for (size_t c = 0; c < 8; ++c) forces[3 * c + axis] += pushed[axis][bits_of(c)];
  }
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
  for (const Cell& corner : brick_corners) {
    const auto gradients =
        shape_gradients(size_mm, {gauss_point(corner, 0), gauss_point(corner, 1), gauss_point(corner, 2)});
    const double weight = stiffness.volume_mm3 / 8;
    std::array<Strain, 24> strains;
    for (size_t n = 0; n < 24; ++n) {
      strains[n] = deviator_of(gradients[n / 3], static_cast<int>(n % 3));
      stiffness.dilation[n] += gradients[n / 3][static_cast<int>(n % 3)] / 8;
    }
    for (size_t a = 0; a < 24; ++a)
      for (size_t b = 0; b < 24; ++b) stiffness.shear[a][b] += weight * product(strains[a], strains[b]);
  }
  find_patterns(stiffness);
  return stiffness;
}

void BrickStiffness::add_forces(double shear_mpa, double bulk_mpa, const BrickVector& u, BrickVector& forces) const {
  add_forces_of<double>(*this, shear_mpa, bulk_mpa, u, forces);
}

void BrickStiffness::add_four(const Four& shear_mpa, const Four& bulk_mpa, const FourVector& u,
                              FourVector& forces) const {
  add_forces_of<Four>(*this, shear_mpa, bulk_mpa, u, forces);
}

BrickConductance brick_conductance(Vec3 size_mm) {
  BrickConductance conductance;
  const double weight = size_mm.x * size_mm.y * size_mm.z / 8;
  for (const Cell& corner : brick_corners) {
    const auto gradients =
        shape_gradients(size_mm, {gauss_point(corner, 0), gauss_point(corner, 1), gauss_point(corner, 2)});
    conductance.diagonal += weight * dot(gradients[0], gradients[0]);
    for (size_t pattern = 0; pattern < 8; ++pattern)
      for (size_t a = 0; a < 8; ++a)
        for (size_t b = 0; b < 8; ++b)
          conductance.patterns[pattern] += weight / 64 * dot(gradients[a], gradients[b]) *
                                           sign_of(pattern, bits_of(a)) * sign_of(pattern, bits_of(b));
  }
  return conductance;
}

void BrickConductance::add_flows(double conductivity, const std::array<double, 8>& values,
                                 std::array<double, 8>& flows) const {
  std::array<double, 8> v;
  for (size_t c = 0; c < 8; ++c) v[bits_of(c)] = values[c];
  transform(v);
  for (size_t pattern = 0; pattern < 8; ++pattern) v[pattern] *= conductivity * patterns[pattern];
  transform(v);
  for (size_t c = 0; c < 8; ++c) flows[c] += v[bits_of(c)];
}

}  // namespace ombre::fea
