#include "fea/solve/homogenise.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "base/system/assert.h"
#include "fea/solve/conjugate_gradients.h"

namespace ombre::fea {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Strain = std::array<double, 6>;

Matrix6 matrix_of(const Stiffness& stiffness) {
  Matrix6 matrix;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) matrix(i, j) = stiffness[static_cast<size_t>(i)][static_cast<size_t>(j)];
  return matrix;
}

Stiffness stiffness_of(const Matrix6& matrix) {
  Stiffness stiffness;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) stiffness[static_cast<size_t>(i)][static_cast<size_t>(j)] = matrix(i, j);
  return stiffness;
}

Matrix6 isotropic(const Moduli& moduli) {
  const double shear = moduli.shear, lambda = moduli.bulk - 2 * shear / 3;
  Matrix6 matrix = Matrix6::Zero();
  matrix.topLeftCorner<3, 3>().setConstant(lambda);
  for (int n = 0; n < 3; ++n) {
    matrix(n, n) += 2 * shear;
    matrix(3 + n, 3 + n) = shear;
  }
  return matrix;
}

// Inverts a symmetric matrix; returns nothing if it is not positive definite within rounding.
std::optional<Matrix6> inverse(const Matrix6& matrix) {
  constexpr double least_share = 1e-9;  // least pivot, as a share of the greatest number
  const Eigen::LDLT<Matrix6> factor(matrix);
  const double greatest = matrix.cwiseAbs().maxCoeff();
  if (!(factor.vectorD().minCoeff() > least_share * greatest)) return std::nullopt;
  return factor.solve(Matrix6::Identity());
}

// Returns the displacement of a uniform strain.
Vec3 even(const Strain& e, Vec3 p) {
  return {e[0] * p.x + 0.5 * (e[3] * p.y + e[5] * p.z), e[1] * p.y + 0.5 * (e[3] * p.x + e[4] * p.z),
          e[2] * p.z + 0.5 * (e[5] * p.x + e[4] * p.y)};
}

// Returns displacements of a brick's nodes under a uniform strain, about its middle, since forces do not depend on its
// place.
BrickVector even_in_brick(const Strain& strain, Vec3 size_mm) {
  BrickVector u{};
  for (size_t c = 0; c < 8; ++c) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = (brick_corners[c][static_cast<size_t>(axis)] - 0.5) * size_mm[axis];
    const Vec3 here = even(strain, p);
    for (int axis = 0; axis < 3; ++axis) u[3 * c + static_cast<size_t>(axis)] = here[axis];
  }
  return u;
}

class Cell6 {
 public:
  Cell6(const Model& model, const SolveOptions& options, Progress* progress, const StopFlag* stop)
      : model_(model),
        progress_(progress),
        operator_(operator_of(model, options.threads)),
        gradients_(operator_, options, nullptr, stop) {}

  Homogenised run() {
    Homogenised result;
    const Bricks& bricks = model_.bricks;
    const double cells = 1.0 * bricks.period[0] * bricks.period[1] * bricks.period[2];
    result.solid_share = bricks.filled_count() / cells;
    add_bounds(result, cells);
    for (size_t load = 0; load < 6; ++load) {
      Strain strain{};
      strain[load] = 1;
      Vector x(operator_.size());
      result.iterations += gradients_.run(forces_of(strain), x).iterations;
      add_column(load, strain, x, cells * bricks.volume_mm3(), result.stiffness_mpa);
      if (progress_) progress_->update({load + 1, 6});
    }
    // The two halves of the matrix differ by the error that iterations leave, so their mean is taken.
    const Matrix6 found = matrix_of(result.stiffness_mpa);
    result.stiffness_mpa = stiffness_of(0.5 * (found + found.transpose()));
    return result;
  }

 private:
  // One node is held, since uniform displacements change nothing.
  static BrickOperator operator_of(const Model& model, int threads) {
    std::vector<Moduli> moduli;
    for (size_t n = 0; n < model.bricks.count(); ++n)
      moduli.push_back(
          moduli_of(model.bricks.share(n) * model.elastic(n).modulus_mpa, model.elastic(n).poissons_ratio));
    std::vector<uint8_t> free(3 * model.bricks.node_count(), 1);
    for (size_t axis = 0; axis < 3; ++axis) free[axis] = 0;
    return {model.bricks, std::move(moduli), std::move(free), threads, {}, own_stiffness(model)};
  }

  BrickVector brick_forces(size_t brick, const BrickVector& u) const {
    BrickVector f{};
    operator_.brick_forces(brick, u.data(), f.data());
    return f;
  }

  // Returns the forces that are missing for balance under a uniform strain.
  Vector forces_of(const Strain& strain) const {
    Vector forces(operator_.size());
    const BrickVector u = even_in_brick(strain, model_.bricks.size_mm);
    for (size_t n = 0; n < model_.bricks.count(); ++n) {
      const BrickVector f = brick_forces(n, u);
      for (size_t d = 0; d < f.size(); ++d) forces[3 * size_t{model_.bricks.nodes[n][d / 3]} + d % 3] -= f[d];
    }
    for (size_t n = 0; n < forces.size(); ++n)
      if (operator_.free()[n] == 0) forces[n] = 0;
    return forces;
  }

  // Computes a column of the stiffness: mean stresses are the work of uniform strains on the forces.
  void add_column(size_t load, const Strain& strain, const Vector& x, double volume_mm3, Stiffness& stiffness) const {
    std::array<BrickVector, 6> tests;
    for (size_t n = 0; n < 6; ++n) {
      Strain unit{};
      unit[n] = 1;
      tests[n] = even_in_brick(unit, model_.bricks.size_mm);
    }
    const BrickVector even_part = even_in_brick(strain, model_.bricks.size_mm);
    for (size_t n = 0; n < model_.bricks.count(); ++n) {
      BrickVector u = even_part;
      for (size_t d = 0; d < u.size(); ++d) u[d] += x[3 * size_t{model_.bricks.nodes[n][d / 3]} + d % 3];
      const BrickVector f = brick_forces(n, u);
      for (size_t row = 0; row < 6; ++row) {
        double work = 0;
        for (size_t d = 0; d < f.size(); ++d) work += tests[row][d] * f[d];
        stiffness[row][load] += work / volume_mm3;
      }
    }
  }

  void add_bounds(Homogenised& result, double cells) const {
    Matrix6 stiffness = Matrix6::Zero(), compliance = Matrix6::Zero();
    std::vector<double> counts(model_.sections.size());
    for (size_t n = 0; n < model_.bricks.count(); ++n) counts[model_.section_of[n]] += model_.bricks.share(n);
    for (size_t n = 0; n < counts.size(); ++n) {
      const Elastic& elastic = model_.sections[n].elastic;
      const Matrix6 own = isotropic(moduli_of(elastic.modulus_mpa, elastic.poissons_ratio));
      const double share = counts[n] / cells;
      stiffness += share * own;
      compliance += share * own.inverse();
    }
    result.voigt_mpa = stiffness_of(stiffness);
    const bool has_void = model_.bricks.filled_count() < cells;
    if (!has_void) result.reuss_mpa = stiffness_of(compliance.inverse());
  }

  const Model& model_;
  Progress* progress_;
  BrickOperator operator_;
  Gradients gradients_;
};

}  // namespace

Homogenised homogenise(const Model& model, const SolveOptions& options, Progress* progress, const StopFlag* stop) {
  for (const int32_t along : model.bricks.period) ASSERT(along > 0);
  return Cell6(model, options, progress, stop).run();
}

std::optional<EngineeringConstants> constants_of(const Stiffness& stiffness) {
  const Matrix6 c = matrix_of(stiffness);
  const auto found = inverse(c);
  if (!found) return std::nullopt;
  const Matrix6& s = *found;
  EngineeringConstants constants;
  for (int n = 0; n < 3; ++n) {
    const auto at = static_cast<size_t>(n);
    constants.modulus_mpa[at] = 1 / s(n, n);
    constants.shear_modulus_mpa[at] = 1 / s(3 + n, 3 + n);
    constants.poissons_ratio[at] = -s((n + 1) % 3, n) / s(n, n);
  }
  const auto sums = [](const Matrix6& m) {
    return std::array{m(0, 0) + m(1, 1) + m(2, 2), m(0, 1) + m(1, 2) + m(2, 0), m(3, 3) + m(4, 4) + m(5, 5)};
  };
  const auto [ca, cb, cc] = sums(c);
  const auto [sa, sb, sc] = sums(s);
  const double bulk_voigt = (ca + 2 * cb) / 9, bulk_reuss = 1 / (sa + 2 * sb);
  const double shear_voigt = (ca - cb + 3 * cc) / 15, shear_reuss = 15 / (4 * sa - 4 * sb + 3 * sc);
  constants.bulk_modulus_mpa = 0.5 * (bulk_voigt + bulk_reuss);
  constants.mean_shear_modulus_mpa = 0.5 * (shear_voigt + shear_reuss);
  constants.universal_anisotropy = 5 * shear_voigt / shear_reuss + bulk_voigt / bulk_reuss - 6;
  return constants;
}

double modulus_along(const Stiffness& stiffness, Vec3 direction) {
  const auto compliance = inverse(matrix_of(stiffness));
  if (!compliance) return 0;
  const Vec3 d = (1 / length(direction)) * direction;
  // The result is one over the strain along d under a stress of 1 along d.
  Eigen::Matrix<double, 6, 1> pull;
  pull << d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.y * d.z, d.z * d.x;
  return 1 / pull.dot(*compliance * pull);
}

}  // namespace ombre::fea
