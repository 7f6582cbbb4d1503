#include "fea/solve/cut_brick.h"

#include <Eigen/Cholesky>
#include <vector>

#include "fea/model/bricks.h"

namespace ombre::fea {
namespace {

// A product of the coordinates of FillMoments, with a factor, less its mean if that is subtracted.
struct Term {
  double factor = 0;  // 0: no term
  std::array<size_t, 3> powers{};
  double shift = 0;
};

// The strain of a mode: that of a displacement by one of the eight products of coordinates, or an enhanced one. Each
// has at most one of xx, yy, zz.
struct Mode {
  std::array<Term, 6> strain{};  // xx, yy, zz, xy, yz, zx
  size_t normal = 3;             // index of its normal strain; 3: none
  Term dilation{};
};

constexpr size_t node_modes = 24, enhanced_modes = 9;
constexpr std::array<std::array<size_t, 2>, 3> axes_of_shear{{{0, 1}, {1, 2}, {2, 0}}};

class Integrals {
 public:
  explicit Integrals(Fill fill) : moments_(fill) {}

  double share() const { return moments_(0, 0, 0); }
  double of(const std::array<size_t, 3>& p) const { return moments_(p[0], p[1], p[2]); }
  double mean(const std::array<size_t, 3>& p) const { return of(p) / share(); }
  double product(const Term& a, const Term& b) const {
    if (a.factor == 0 || b.factor == 0) return 0;
    std::array<size_t, 3> both{};
    for (size_t n = 0; n < 3; ++n) both[n] = a.powers[n] + b.powers[n];
    return a.factor * b.factor *
           (of(both) - a.shift * of(b.powers) - b.shift * of(a.powers) + a.shift * b.shift * share());
  }

 private:
  FillMoments moments_;
};

// Returns the derivative along an axis of the product whose powers are the pattern's bits.
Term derivative(size_t pattern, size_t axis, Vec3 size_mm) {
  if (((pattern >> axis) & 1) == 0) return {};
  const size_t rest = pattern ^ (size_t{1} << axis);
  return {-2 / size_mm[static_cast<int>(axis)], {rest & 1, (rest >> 1) & 1, (rest >> 2) & 1}, 0};
}

Mode mode_of(size_t pattern, size_t axis, Vec3 size_mm, const Integrals& integrals) {
  Mode mode;
  mode.strain[axis] = derivative(pattern, axis, size_mm);
  if (mode.strain[axis].factor != 0) mode.normal = axis;
  for (size_t n = 0; n < 3; ++n)
    for (const size_t side : {size_t{0}, size_t{1}})
      if (axes_of_shear[n][side] == axis) mode.strain[3 + n] = derivative(pattern, axes_of_shear[n][1 - side], size_mm);
  mode.dilation = mode.strain[axis];
  const auto& powers = mode.dilation.powers;
  if (powers[0] + powers[1] + powers[2] > 1) mode.dilation = {mode.dilation.factor * integrals.mean(powers), {}, 0};
  return mode;
}

// Returns the strain component of an enhanced mode, and the axis along which it is linear.
std::pair<size_t, size_t> enhanced_place(size_t mode) {
  if (mode < 3) return {mode, mode};
  return {3 + (mode - 3) / 2, axes_of_shear[(mode - 3) / 2][(mode - 3) % 2]};
}

// Returns a strain that is linear along an axis, and 0 on average.
Mode enhanced_mode(size_t component, size_t axis, const Integrals& integrals) {
  Mode mode;
  Term& term = mode.strain[component];
  term.factor = 1;
  term.powers[axis] = 1;
  term.shift = integrals.mean(term.powers);
  if (component < 3) {
    mode.normal = component;
    mode.dilation = term;
  }
  return mode;
}

std::vector<Mode> modes_of(Vec3 size_mm, const Integrals& integrals) {
  std::vector<Mode> modes;
  for (size_t pattern = 0; pattern < 8; ++pattern)
    for (size_t axis = 0; axis < 3; ++axis) modes.push_back(mode_of(pattern, axis, size_mm, integrals));
  for (size_t mode = 0; mode < enhanced_modes; ++mode) {
    const auto [component, axis] = enhanced_place(mode);
    modes.push_back(enhanced_mode(component, axis, integrals));
  }
  return modes;
}

double energy(const Mode& a, const Mode& b, const Integrals& integrals, double shear, double bulk) {
  double sum = 0;
  for (size_t n = 0; n < 3; ++n) sum += 2 * integrals.product(a.strain[n], b.strain[n]);
  if (a.normal < 3 && b.normal < 3) sum -= 2.0 / 3 * integrals.product(a.strain[a.normal], b.strain[b.normal]);
  for (size_t n = 3; n < 6; ++n) sum += integrals.product(a.strain[n], b.strain[n]);
  return shear * sum + bulk * integrals.product(a.dilation, b.dilation);
}

// Returns an eighth of a corner's value in a product of coordinates; these factors make products from values at
// corners.
double eighth_at(size_t pattern, size_t corner) {
  double value = 1.0 / 8;
  for (size_t axis = 0; axis < 3; ++axis)
    if (((pattern >> axis) & 1) != 0 && brick_corners[corner][axis] == 1) value = -value;
  return value;
}

// Returns the matrix from corners to products, with `each` unknowns for each.
Eigen::MatrixXd products_from_corners(Eigen::Index each) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(8 * each, 8 * each);
  for (Eigen::Index pattern = 0; pattern < 8; ++pattern)
    for (Eigen::Index corner = 0; corner < 8; ++corner)
      for (Eigen::Index n = 0; n < each; ++n)
        matrix(each * pattern + n, each * corner + n) =
            eighth_at(static_cast<size_t>(pattern), static_cast<size_t>(corner));
  return matrix;
}

template <class Packed>
Packed packed(const Eigen::MatrixXd& matrix, double factor) {
  Packed result{};
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column <= row; ++column)
      result[packed_place(static_cast<size_t>(row), static_cast<size_t>(column))] = factor * matrix(row, column);
  return result;
}

// Returns the energies of pairs of modes, displacements first.
Eigen::MatrixXd energies_of(Vec3 size_mm, const Integrals& integrals, double shear_mpa, double bulk_mpa) {
  const std::vector<Mode> modes = modes_of(size_mm, integrals);
  constexpr auto all = static_cast<Eigen::Index>(node_modes + enhanced_modes);
  Eigen::MatrixXd energies(all, all);
  for (Eigen::Index a = 0; a < all; ++a)
    for (Eigen::Index b = 0; b <= a; ++b)
      energies(a, b) = energies(b, a) =
          energy(modes[static_cast<size_t>(a)], modes[static_cast<size_t>(b)], integrals, shear_mpa, bulk_mpa);
  return energies;
}

}  // namespace

PackedStiffness cut_stiffness(Vec3 size_mm, Fill fill, double shear_mpa, double bulk_mpa) {
  static const Eigen::MatrixXd from_corners = products_from_corners(3);
  const Eigen::MatrixXd energies = energies_of(size_mm, Integrals(fill), shear_mpa, bulk_mpa);
  const Eigen::MatrixXd mixed = energies.topRightCorner(node_modes, enhanced_modes);
  const Eigen::LDLT<Eigen::MatrixXd> enhanced(energies.bottomRightCorner(enhanced_modes, enhanced_modes));
  const Eigen::MatrixXd condensed =
      energies.topLeftCorner(node_modes, node_modes) - mixed * enhanced.solve(mixed.transpose());
  return packed<PackedStiffness>(from_corners.transpose() * condensed * from_corners,
                                 size_mm.x * size_mm.y * size_mm.z);
}

EnhancedStrains::EnhancedStrains(Vec3 size_mm, Fill fill, double shear_mpa, double bulk_mpa) {
  const Integrals integrals(fill);
  const Eigen::MatrixXd energies = energies_of(size_mm, integrals, shear_mpa, bulk_mpa);
  const Eigen::LDLT<Eigen::MatrixXd> enhanced(energies.bottomRightCorner(enhanced_modes, enhanced_modes));
  const Eigen::MatrixXd factors =
      -enhanced.solve(energies.bottomLeftCorner(enhanced_modes, node_modes)) * products_from_corners(3);
  for (size_t mode = 0; mode < enhanced_modes; ++mode)
    for (size_t n = 0; n < node_modes; ++n)
      by_displacement_[mode][n] = factors(static_cast<Eigen::Index>(mode), static_cast<Eigen::Index>(n));
  means_ = {integrals.mean({1, 0, 0}), integrals.mean({0, 1, 0}), integrals.mean({0, 0, 1})};
}

std::array<double, 6> EnhancedStrains::at(const BrickVector& displacements, Vec3 place) const {
  std::array<double, 6> strain{};
  for (size_t mode = 0; mode < enhanced_modes; ++mode) {
    double factor = 0;
    for (size_t n = 0; n < node_modes; ++n) factor += by_displacement_[mode][n] * displacements[n];
    const auto [component, axis] = enhanced_place(mode);
    const auto at = static_cast<int>(axis);
    strain[component] += factor * (1 - 2 * place[at] - means_[at]);
  }
  return strain;
}

PackedConductance cut_conductance(Vec3 size_mm, Fill fill) {
  static const Eigen::MatrixXd from_corners = products_from_corners(1);
  const Integrals integrals(fill);
  Eigen::MatrixXd energies = Eigen::MatrixXd::Zero(8, 8);
  for (size_t a = 0; a < 8; ++a)
    for (size_t b = 0; b < 8; ++b)
      for (size_t axis = 0; axis < 3; ++axis)
        energies(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) +=
            integrals.product(derivative(a, axis, size_mm), derivative(b, axis, size_mm));
  return packed<PackedConductance>(from_corners.transpose() * energies * from_corners,
                                   size_mm.x * size_mm.y * size_mm.z);
}

}  // namespace ombre::fea
