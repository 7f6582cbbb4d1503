#include "optimise/topology.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "fea/brick_operator.h"
#include "fea/multigrid.h"
#include "optimise/density_filter.h"

namespace ombre::optimise {
namespace {

using fea::Vector;

constexpr size_t most_iterations = 20'000;
constexpr double least_cost = 1e-30;  // of a density that no step moves

// Displacements under loads that stay the same, for moduli that change a little from one solution to the next.
class Equilibrium {
 public:
  Equilibrium(const fea::Model& model, const fea::Conditions& conditions, const TopologyOptions& options,
              const StopFlag* stop)
      : model_(model),
        options_(options),
        stop_(stop),
        free_(3 * model.bricks.node_count(), 1),
        loads_(free_.size()),
        x_(free_.size()),
        stiffness_(fea::brick_stiffness(model.bricks.size_mm)) {
    for (const fea::Prescribed& held : conditions.displacements) free_[3 * size_t{held.node} + held.axis] = 0;
    for (const fea::Prescribed& force : conditions.forces)
      if (free_[3 * size_t{force.node} + force.axis] != 0) loads_[3 * size_t{force.node} + force.axis] = force.value;
  }

  // The compliance, N mm, where each brick has this share of its modulus.
  double solve(const Vector& shares) {
    std::vector<fea::Moduli> moduli(shares.size());
    for (size_t n = 0; n < shares.size(); ++n) {
      const fea::Moduli full = full_moduli(n);
      moduli[n] = {full.shear * shares[n], full.bulk * shares[n]};
    }
    const fea::BrickOperator stiffness(model_.bricks, std::move(moduli), free_, options_.threads);
    run_gradients(stiffness);
    return fea::dot(loads_, x_, options_.threads);
  }

  // Twice the strain energy of each brick, if it had its full modulus.
  Vector energies() const {
    Vector result(model_.bricks.count());
    fea::for_pieces(result.size(), options_.threads, [&](size_t begin, size_t end) {
      for (size_t n = begin; n < end; ++n) result[n] = energy(n);
    });
    return result;
  }

 private:
  fea::Moduli full_moduli(size_t brick) const {
    const fea::Elastic& elastic = model_.elastic(brick);
    return fea::moduli_of(elastic.modulus_mpa, elastic.poissons_ratio);
  }

  double energy(size_t brick) const {
    fea::BrickVector u{}, forces{};
    for (size_t c = 0; c < 8; ++c)
      for (size_t axis = 0; axis < 3; ++axis) u[3 * c + axis] = x_[3 * size_t{model_.bricks.nodes[brick][c]} + axis];
    const fea::Moduli full = full_moduli(brick);
    stiffness_.add_forces(full.shear, full.bulk, u, forces);
    double sum = 0;
    for (size_t n = 0; n < u.size(); ++n) sum += u[n] * forces[n];
    return sum;
  }

  // Conjugate gradients from the last displacements.
  void run_gradients(const fea::BrickOperator& stiffness) {
    const int threads = options_.threads;
    fea::Multigrid multigrid(stiffness);
    Vector residual, z, p, q;
    stiffness.forces(x_, q);
    residual = loads_;
    for (size_t n = 0; n < residual.size(); ++n) residual[n] -= q[n];
    const double scale = std::sqrt(fea::dot(loads_, loads_, threads));
    double rz = 0;
    for (size_t iteration = 0;; ++iteration) {
      if (stop_ && stop_->requested()) throw Cancelled();
      const double now = std::sqrt(fea::dot(residual, residual, threads)) / scale;
      if (now <= options_.tolerance) return;
      if (!std::isfinite(now) || iteration >= most_iterations)
        throw Error(Code::not_solved, "the equations did not converge: after " + format_count(iteration) +
                                          " iterations the forces are still off by " + format_rounded(now, 2) +
                                          " of the loads; support more of the part, or choose smaller bricks");
      multigrid.apply(residual, z);
      const double next = fea::dot(residual, z, threads), beta = iteration == 0 ? 0 : next / rz;
      rz = next;
      p.resize(z.size());
      fea::for_pieces(p.size(), threads, [&](size_t begin, size_t end) {
        for (size_t n = begin; n < end; ++n) p[n] = z[n] + beta * p[n];
      });
      stiffness.forces(p, q);
      const double alpha = rz / fea::dot(p, q, threads);
      fea::for_pieces(p.size(), threads, [&](size_t begin, size_t end) {
        for (size_t n = begin; n < end; ++n) {
          x_[n] += alpha * p[n];
          residual[n] -= alpha * q[n];
        }
      });
    }
  }

  const fea::Model& model_;
  const TopologyOptions& options_;
  const StopFlag* stop_;
  std::vector<uint8_t> free_;
  Vector loads_, x_;
  fea::BrickStiffness stiffness_;
};

// Draws densities towards 0 and 1: tanh about a half, from 0 to 1. Steepness 0 leaves them.
struct Projection {
  double steepness = 0;

  double operator()(double density) const {
    if (steepness == 0) return density;
    const double edge = std::tanh(steepness / 2);
    return (edge + std::tanh(steepness * (density - 0.5))) / (2 * edge);
  }
  double slope(double density) const {
    if (steepness == 0) return 1;
    const double at = std::tanh(steepness * (density - 0.5));
    return steepness * (1 - at * at) / (2 * std::tanh(steepness / 2));
  }
};

class TopologySearch {
 public:
  TopologySearch(const fea::Model& model, const fea::Conditions& conditions, const TopologyOptions& options,
                 const StopFlag* stop)
      : options_(options),
        count_(model.bricks.count()),
        filter_(model.bricks, options.radius_mm, options.threads),
        equilibrium_(model, conditions, options, stop),
        design_(count_, options.volume_fraction),
        projection_{std::min(1.0, options.projection)} {}

  Topology run(const std::function<void(const TopologyStep&)>& told) {
    Topology topology;
    find_density(design_);
    size_t since = 0;  // steps with this projection
    for (size_t number = 1; number <= options_.steps; ++number) {
      TopologyStep step{number, equilibrium_.solve(shares()), mean(density_), 0, greyness()};
      step.change = move();
      topology.steps.push_back(step);
      if (told) told(step);
      const bool is_last = projection_.steepness >= options_.projection, is_still = step.change <= options_.change;
      if (is_last && is_still) break;
      if (is_last || (!is_still && ++since < options_.projection_steps)) continue;
      projection_.steepness = std::min(2 * projection_.steepness, options_.projection);
      since = 0;
      find_density(design_);
    }
    topology.density.assign(density_.begin(), density_.end());
    return topology;
  }

 private:
  static double mean(const Vector& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }

  double greyness() const {
    double sum = 0;
    for (const double density : density_) sum += 4 * density * (1 - density);
    return sum / static_cast<double>(count_);
  }

  void find_density(const Vector& design) {
    filtered_ = filter_.apply(design);
    density_ = filtered_;
    for (double& density : density_) density = projection_(density);
  }

  Vector shares() const {
    Vector result(count_);
    for (size_t n = 0; n < count_; ++n)
      result[n] = options_.least + std::pow(density_[n], options_.penalty) * (1 - options_.least);
    return result;
  }

  // A step by optimality criteria, with the multiplier that keeps the volume. Returns the greatest change.
  double move() {
    const Vector energies = equilibrium_.energies();
    Vector gain(count_), cost(count_);
    for (size_t n = 0; n < count_; ++n) {
      cost[n] = projection_.slope(filtered_[n]);
      gain[n] =
          options_.penalty * std::pow(density_[n], options_.penalty - 1) * (1 - options_.least) * energies[n] * cost[n];
    }
    gain = filter_.apply_transposed(gain);
    cost = filter_.apply_transposed(cost);
    for (double& here : cost) here = std::max(here, least_cost);
    Vector next(count_);
    double low = 0, high = 1e9;
    for (size_t n = 0; n < count_; ++n) high = std::max(high, 1e9 * gain[n] / cost[n]);
    while ((high - low) / (low + high) > 1e-6) {
      const double multiplier = (low + high) / 2;
      for (size_t n = 0; n < count_; ++n) {
        const double wanted = design_[n] * std::sqrt(std::max(gain[n] / cost[n] / multiplier, 0.0));
        next[n] =
            std::clamp(wanted, std::max(0.0, design_[n] - options_.move), std::min(1.0, design_[n] + options_.move));
      }
      find_density(next);
      (mean(density_) > options_.volume_fraction ? low : high) = multiplier;
    }
    double change = 0;
    for (size_t n = 0; n < count_; ++n) change = std::max(change, std::abs(next[n] - design_[n]));
    design_ = std::move(next);
    return change;
  }

  const TopologyOptions& options_;
  size_t count_;
  DensityFilter filter_;
  Equilibrium equilibrium_;
  Vector design_, filtered_, density_;
  Projection projection_;
};

}  // namespace

Topology find_topology(const fea::Model& model, const fea::Conditions& conditions, const TopologyOptions& options,
                       const std::function<void(const TopologyStep&)>& told, const StopFlag* stop) {
  return TopologySearch(model, conditions, options, stop).run(told);
}

}  // namespace ombre::optimise
