#include "optimise/topology.h"

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "base/text/text.h"
#include "fea/solve/brick_operator.h"
#include "fea/solve/multigrid.h"
#include "optimise/density_filter.h"

namespace ombre::optimise {
namespace {

using fea::Vector;

constexpr size_t most_iterations = 20'000;
constexpr double least_cost = 1e-30;  // cost of a density that no step moves
constexpr double damped_power = 0.3;

// Solves for displacements under constant loads, for moduli that change a little from one solution to the next.
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
        adjoint_(options.goal ? free_.size() : 0),
        stiffness_(fea::brick_stiffness(model.bricks.size_mm)) {
    for (const fea::Prescribed& held : conditions.displacements) free_[3 * size_t{held.node} + held.axis] = 0;
    take_forces(conditions.forces, loads_);
    if (!options.goal) return;
    unit_.resize(free_.size());
    take_forces(options.goal->unit_forces, unit_);
    if (fea::dot(unit_, unit_, 1) > 0) return;
    throw Error(Code::not_solved,
                "the supports hold the displacement that the topology is to change: choose it elsewhere");
  }

  // Solves with this share of each brick's modulus.
  void solve(const Vector& shares) {
    std::vector<fea::Moduli> moduli(shares.size());
    for (size_t n = 0; n < shares.size(); ++n) {
      const fea::Moduli full = full_moduli(n);
      moduli[n] = {full.shear * shares[n], full.bulk * shares[n]};
    }
    const fea::BrickOperator stiffness(model_.bricks, std::move(moduli), free_, options_.threads);
    fea::Multigrid multigrid(stiffness);
    run_gradients(stiffness, multigrid, loads_, x_);
    if (options_.goal) run_gradients(stiffness, multigrid, unit_, adjoint_);
  }

  double compliance() const { return fea::dot(loads_, x_, options_.threads); }  // N mm
  double displacement() const { return options_.goal ? fea::dot(unit_, x_, options_.threads) : 0; }

  // Returns twice the strain energy that each brick would have with its full modulus; with a goal, the product of
  // displacements and adjoint displacements. This is minus the derivative of the compliance, or of the goal, by the
  // share of the modulus.
  Vector energies() const {
    Vector result(model_.bricks.count());
    fea::for_pieces(result.size(), options_.threads, [&](size_t begin, size_t end) {
      for (size_t n = begin; n < end; ++n) result[n] = energy(n);
    });
    return result;
  }

 private:
  void take_forces(const std::vector<fea::Prescribed>& forces, Vector& into) const {
    for (const fea::Prescribed& force : forces)
      if (free_[3 * size_t{force.node} + force.axis] != 0) into[3 * size_t{force.node} + force.axis] = force.value;
  }

  fea::Moduli full_moduli(size_t brick) const {
    const fea::Elastic& elastic = model_.elastic(brick);
    return fea::moduli_of(elastic.modulus_mpa, elastic.poissons_ratio);
  }

  double energy(size_t brick) const {
    fea::BrickVector u{}, v{}, forces{};
    const Vector& other = options_.goal ? adjoint_ : x_;
    for (size_t c = 0; c < 8; ++c)
      for (size_t axis = 0; axis < 3; ++axis) {
        const size_t at = 3 * size_t{model_.bricks.nodes[brick][c]} + axis;
        u[3 * c + axis] = x_[at];
        v[3 * c + axis] = other[at];
      }
    const fea::Moduli full = full_moduli(brick);
    stiffness_.add_forces(full.shear, full.bulk, u, forces);
    double sum = 0;
    for (size_t n = 0; n < u.size(); ++n) sum += v[n] * forces[n];
    return sum;
  }

  // Runs conjugate gradients from the last displacements.
  void run_gradients(const fea::BrickOperator& stiffness, fea::Multigrid& multigrid, const Vector& loads,
                     Vector& x) const {
    const int threads = options_.threads;
    Vector residual, z, p, q;
    stiffness.forces(x, q);
    residual = loads;
    for (size_t n = 0; n < residual.size(); ++n) residual[n] -= q[n];
    const double scale = std::sqrt(fea::dot(loads, loads, threads));
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
          x[n] += alpha * p[n];
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
  Vector unit_, adjoint_;  // forces of the goal, and the displacements under them
  fea::BrickStiffness stiffness_;
};

// Moves densities towards 0 and 1 by tanh about a half. Steepness 0 leaves them as they are.
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

// Returns the share of its modulus that a brick of this density has, and its derivative.
double share_of_density(const TopologyOptions& options, double density) {
  return options.least + std::pow(density, options.penalty) * (1 - options.least);
}
double slope_of_share(const TopologyOptions& options, double density) {
  return options.penalty * std::pow(density, options.penalty - 1) * (1 - options.least);
}

Vector shares_of_densities(const TopologyOptions& options, const Vector& density) {
  Vector shares(density.size());
  for (size_t n = 0; n < shares.size(); ++n) shares[n] = share_of_density(options, density[n]);
  return shares;
}

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

  Topology run(const std::function<void(const TopologyStep&)>& report) {
    Topology topology;
    find_density(design_);
    size_t since = 0;  // number of steps with this projection
    for (size_t number = 1; number <= options_.steps; ++number) {
      equilibrium_.solve(shares_of_densities(options_, density_));
      TopologyStep step{number, equilibrium_.compliance(), equilibrium_.displacement(), mean(density_), 0, greyness()};
      step.change = move();
      topology.steps.push_back(step);
      if (report) report(step);
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
  static double power_of(double value, double power) {
    return power == 0.5 ? std::sqrt(value) : std::pow(value, power);
  }

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

  // Takes a step by optimality criteria, with the multiplier that keeps the volume. Returns the greatest change.
  double move() {
    const Vector energies = equilibrium_.energies();
    const double sign = options_.goal && options_.goal->is_greatest ? -1 : 1;
    Vector gain(count_), cost(count_);
    for (size_t n = 0; n < count_; ++n) {
      cost[n] = projection_.slope(filtered_[n]);
      gain[n] = sign * slope_of_share(options_, density_[n]) * energies[n] * cost[n];
    }
    gain = filter_.apply_transposed(gain);
    cost = filter_.apply_transposed(cost);
    for (double& here : cost) here = std::max(here, least_cost);
    // The volume is constant, so adding one number to all gains changes nothing. The shift leaves no gain below 0.
    double shift = 0;
    for (size_t n = 0; n < count_; ++n) shift = std::max(shift, -gain[n] / cost[n]);
    for (size_t n = 0; n < count_; ++n) gain[n] += shift * cost[n];
    const double power = shift > 0 ? damped_power : 0.5;
    Vector next(count_);
    double low = 0, high = 1e9;
    for (size_t n = 0; n < count_; ++n) high = std::max(high, 1e9 * gain[n] / cost[n]);
    while ((high - low) / (low + high) > 1e-6) {
      const double multiplier = (low + high) / 2;
      for (size_t n = 0; n < count_; ++n) {
        const double wanted = design_[n] * power_of(std::max(gain[n] / cost[n] / multiplier, 0.0), power);
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
                       const std::function<void(const TopologyStep&)>& report, const StopFlag* stop) {
  return TopologySearch(model, conditions, options, stop).run(report);
}

TopologySlopes topology_slopes(const fea::Model& model, const fea::Conditions& conditions,
                               const TopologyOptions& options, const std::vector<double>& density) {
  Equilibrium equilibrium(model, conditions, options, nullptr);
  equilibrium.solve(shares_of_densities(options, Vector(density.begin(), density.end())));
  TopologySlopes slopes{options.goal ? equilibrium.displacement() : equilibrium.compliance(), {}};
  const Vector energies = equilibrium.energies();
  for (size_t n = 0; n < density.size(); ++n)
    slopes.by_density.push_back(-slope_of_share(options, density[n]) * energies[n]);
  return slopes;
}

}  // namespace ombre::optimise
