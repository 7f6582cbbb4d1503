#include "fea/solve/multigrid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text/error.h"

namespace ombre::fea {
namespace {

constexpr size_t most_direct_nodes = 300;  // nodes of a level that is solved directly
constexpr size_t degree = 3;               // degree of the smoothing polynomial
constexpr double smoothed_share = 0.1;     // the smoother reduces the spectrum from this share of its upper end on
constexpr double spectrum_room = 1.1;      // safety factor on the estimated spectrum
constexpr int power_rounds = 12;

// A fine node's place in a coarse brick: its offset in fine bricks from the brick's least corner, 0 to 2 along each
// axis.
struct Parent {
  uint32_t brick = 0;
  std::array<uint8_t, 3> offset{};
};

Cell half(const Cell& cell) { return {cell[0] >> 1, cell[1] >> 1, cell[2] >> 1}; }

bool can_halve(const Cell& period) {
  return std::ranges::none_of(period, [](int32_t along) { return (along & 1) != 0; });
}

// Returns the weights of the corners of the coarse brick at a fine node.
std::array<double, 8> weights_at(const std::array<uint8_t, 3>& offset) {
  std::array<double, 8> weights{};
  for (size_t c = 0; c < 8; ++c) {
    weights[c] = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double at = 0.5 * offset[axis];
      weights[c] *= brick_corners[c][axis] == 1 ? at : 1 - at;
    }
  }
  return weights;
}

// The coarse bricks, their moduli, and the places of fine nodes in them.
struct Coarse {
  Bricks bricks;
  std::vector<Moduli> moduli;
  std::vector<Parent> parents;
  std::vector<uint8_t> free;
  Vector more_diagonal;
};

// Spreads what a node adds to the diagonal over the coarse nodes around it, by their weights.
void coarsen_diagonal(const BrickOperator& fine, Coarse& coarse) {
  if (fine.more_diagonal().empty()) return;
  const size_t unknowns = fine.unknowns();
  coarse.more_diagonal.assign(unknowns * coarse.bricks.node_count(), 0);
  for (size_t n = 0; n < fine.size(); ++n) {
    const Parent& parent = coarse.parents[n / unknowns];
    const auto weights = weights_at(parent.offset);
    for (size_t c = 0; c < 8; ++c)
      coarse.more_diagonal[unknowns * coarse.bricks.nodes[parent.brick][c] + n % unknowns] +=
          weights[c] * fine.more_diagonal()[n];
  }
}

Coarse coarsen(const BrickOperator& fine) {
  const Bricks& bricks = fine.bricks();
  std::vector<Cell> cells;
  cells.reserve(bricks.count());
  for (const Cell& cell : bricks.cells) cells.push_back(half(cell));
  std::ranges::sort(cells, is_before);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  Coarse coarse;
  coarse.bricks = make_bricks(bricks.origin, 2.0 * bricks.size_mm, std::move(cells), half(bricks.period));
  coarse.moduli.resize(coarse.bricks.count());
  coarse.parents.resize(bricks.node_count());
  for (size_t n = 0; n < bricks.count(); ++n) {
    const Cell cell = half(bricks.cells[n]);
    const auto place = std::ranges::lower_bound(coarse.bricks.cells, cell, is_before);
    const auto parent = static_cast<uint32_t>(place - coarse.bricks.cells.begin());
    coarse.moduli[parent].shear += fine.moduli()[n].shear / 8;
    coarse.moduli[parent].bulk += fine.moduli()[n].bulk / 8;
    for (size_t c = 0; c < 8; ++c) {
      Parent& of_node = coarse.parents[bricks.nodes[n][c]];
      of_node.brick = parent;
      for (size_t axis = 0; axis < 3; ++axis)
        of_node.offset[axis] = static_cast<uint8_t>(bricks.cells[n][axis] + brick_corners[c][axis] - 2 * cell[axis]);
    }
  }
  // A coarse node is held if the fine node in its place is.
  const size_t unknowns = fine.unknowns();
  coarse.free.assign(unknowns * coarse.bricks.node_count(), 1);
  for (size_t node = 0; node < bricks.node_count(); ++node) {
    const Parent& parent = coarse.parents[node];
    const auto weights = weights_at(parent.offset);
    const auto same = std::ranges::find(weights, 1.0);
    if (same == weights.end()) continue;
    const size_t at = coarse.bricks.nodes[parent.brick][static_cast<size_t>(same - weights.begin())];
    for (size_t n = 0; n < unknowns; ++n) coarse.free[unknowns * at + n] = fine.free()[unknowns * node + n];
  }
  coarsen_diagonal(fine, coarse);
  return coarse;
}

// Returns numbers from -0.5 to 0.5 with all frequencies, by the last step of splitmix64 (Steele, Lea and Flood, 2014).
double noise(uint64_t n) {
  n = (n + 1) * 0x9e3779b97f4a7c15U;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9U;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebU;
  return static_cast<double>((n ^ (n >> 31)) >> 11) * 0x1p-53 - 0.5;
}

using Factor = Eigen::LDLT<Eigen::MatrixXd>;

// Factorises a level. Unknowns that are held or undetermined have pivots of 0, and become 0.
Factor factor_of(const BrickOperator& level) {
  const auto size = static_cast<Eigen::Index>(level.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Vector unit(level.size()), column;
  for (Eigen::Index n = 0; n < size; ++n) {
    const auto place = static_cast<size_t>(n);
    if (level.free()[place] == 0) continue;
    unit[place] = 1;
    level.forces(unit, column);
    unit[place] = 0;
    matrix.col(n) = Eigen::Map<const Eigen::VectorXd>(column.data(), size);
  }
  return Factor(matrix);
}

}  // namespace

struct Multigrid::Level {
  const BrickOperator* fine = nullptr;
  std::unique_ptr<BrickOperator> own;  // operator of all levels but the finest
  std::vector<Parent> parents;         // places of its nodes in the next level
  std::optional<Factor> direct;        // factor of the last level
  double spectrum = 0;                 // about the greatest eigenvalue of diagonal^-1 stiffness
  Vector residual, step, forces, below, coarse_forces, coarse_displacements;

  void find_spectrum(const StopFlag* stop) {
    const Vector& inverse = fine->inverse_diagonal();
    Vector vector(fine->size());
    for (size_t n = 0; n < vector.size(); ++n) vector[n] = inverse[n] > 0 ? noise(n) : 0;
    for (int round = 0; round < power_rounds; ++round) {
      if (stop && stop->requested()) throw Cancelled();
      const double norm = std::sqrt(dot(vector, vector, fine->threads()));
      if (!(norm > 0)) break;
      for (double& x : vector) x /= norm;
      fine->forces(vector, forces);
      for (size_t n = 0; n < vector.size(); ++n) vector[n] = inverse[n] * forces[n];
      spectrum = std::sqrt(dot(vector, vector, fine->threads()));
    }
  }

  // Applies Chebyshev's polynomial in the stiffness and its diagonal (Adams et al., 2003), from displacements 0 or `x`.
  void smooth(const Vector& right, Vector& x, bool from_zero) {
    const double upper = spectrum_room * spectrum, lower = smoothed_share * spectrum;
    const double middle = 0.5 * (upper + lower), radius = 0.5 * (upper - lower);
    double rho = radius / middle;
    const Vector& inverse = fine->inverse_diagonal();
    if (from_zero) {
      residual = right;
      x.assign(right.size(), 0);
    } else {
      subtract_forces(right, x);
    }
    step.resize(right.size());
    for (size_t n = 0; n < degree; ++n) {
      const double next = 1 / (2 * middle / radius - rho);
      const double keep = n == 0 ? 0 : next * rho, add = n == 0 ? 1 / middle : 2 * next / radius;
      for_pieces(x.size(), fine->threads(), [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
          step[i] = (n == 0 ? 0 : keep * step[i]) + add * inverse[i] * residual[i];
          x[i] += step[i];
        }
      });
      if (n > 0) rho = next;
      if (n + 1 < degree) subtract_forces(right, x);
    }
  }

  // Computes residual = right - stiffness x.
  void subtract_forces(const Vector& right, const Vector& x) {
    fine->forces(x, forces);
    residual.resize(right.size());
    for_pieces(x.size(), fine->threads(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) residual[i] = right[i] - forces[i];
    });
  }

  void restrict_to(const BrickOperator& coarse) {
    coarse_forces.assign(coarse.size(), 0);
    const size_t unknowns = coarse.unknowns();
    for (size_t node = 0; node < parents.size(); ++node) {
      const auto weights = weights_at(parents[node].offset);
      const auto& corners = coarse.bricks().nodes[parents[node].brick];
      for (size_t c = 0; c < 8; ++c)
        for (size_t n = 0; n < unknowns && weights[c] > 0; ++n)
          coarse_forces[unknowns * corners[c] + n] += weights[c] * residual[unknowns * node + n];
    }
    for (size_t n = 0; n < coarse_forces.size(); ++n)
      if (coarse.free()[n] == 0) coarse_forces[n] = 0;
  }

  void add_from(const BrickOperator& coarse, Vector& x) const {
    const size_t unknowns = coarse.unknowns();
    for_pieces(parents.size(), fine->threads(), [&](size_t begin, size_t end) {
      for (size_t node = begin; node < end; ++node) {
        const auto weights = weights_at(parents[node].offset);
        const auto& corners = coarse.bricks().nodes[parents[node].brick];
        for (size_t n = 0; n < unknowns; ++n) {
          if (fine->free()[unknowns * node + n] == 0) continue;
          double sum = 0;
          for (size_t c = 0; c < 8; ++c) sum += weights[c] * coarse_displacements[unknowns * corners[c] + n];
          x[unknowns * node + n] += sum;
        }
      }
    });
  }
};

Multigrid::Multigrid(const BrickOperator& finest, const StopFlag* stop) : stop_(stop) {
  levels_.push_back(std::make_unique<Level>());
  levels_.back()->fine = &finest;
  while (levels_.back()->fine->bricks().node_count() > most_direct_nodes) {
    const BrickOperator& fine = *levels_.back()->fine;
    if (!can_halve(fine.bricks().period)) break;
    Coarse coarse = coarsen(fine);
    if (coarse.bricks.count() == fine.bricks().count()) break;  // only single bricks that lie far apart are left
    levels_.back()->parents = std::move(coarse.parents);
    auto next = std::make_unique<Level>();
    next->own =
        std::make_unique<BrickOperator>(std::move(coarse.bricks), std::move(coarse.moduli), std::move(coarse.free),
                                        fine.threads(), std::move(coarse.more_diagonal));
    next->fine = next->own.get();
    levels_.push_back(std::move(next));
  }
  for (auto& level : levels_) level->find_spectrum(stop);
  Level& last = *levels_.back();
  if (last.fine->bricks().node_count() <= most_direct_nodes) last.direct = factor_of(*last.fine);
}

Multigrid::~Multigrid() = default;

void Multigrid::apply(const Vector& forces, Vector& displacements) { cycle(0, forces, displacements); }

void Multigrid::cycle(size_t number, const Vector& forces, Vector& displacements) {
  Level& level = *levels_[number];
  if (level.direct) {
    const auto size = static_cast<Eigen::Index>(forces.size());
    displacements.resize(forces.size());
    Eigen::Map<Eigen::VectorXd>(displacements.data(), size) =
        level.direct->solve(Eigen::Map<const Eigen::VectorXd>(forces.data(), size));
    return;
  }
  const auto stop_if_requested = [this] {
    if (stop_ && stop_->requested()) throw Cancelled();
  };
  level.smooth(forces, displacements, true);
  stop_if_requested();
  if (number + 1 < levels_.size()) {
    const BrickOperator& coarse = *levels_[number + 1]->fine;
    level.subtract_forces(forces, displacements);
    level.restrict_to(coarse);
    cycle(number + 1, level.coarse_forces, level.coarse_displacements);
    level.add_from(coarse, displacements);
  }
  stop_if_requested();
  level.smooth(forces, displacements, false);
}

}  // namespace ombre::fea
