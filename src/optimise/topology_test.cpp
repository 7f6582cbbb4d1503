#include "optimise/topology.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/text/error.h"
#include "fea/model/test_models.h"
#include "optimise/density_filter.h"

namespace ombre::optimise {
namespace {

// A wall bracket, held at x = 0 and pulled down at its far end.
struct Bracket {
  fea::Model model = fea::test::model_of(fea::test::block({12, 6, 1}, {1, 1, 1}), {1, 0.3, 0});
  fea::Conditions conditions = fea::test::held(
      model.bricks, [](Vec3 p) { return p.x == 0; }, [](Vec3) { return Vec3{}; });

  Bracket() {
    for (uint32_t n = 0; n < model.bricks.node_count(); ++n)
      if (const Vec3 p = model.bricks.node(n); p.x == 12 && p.y == 3) conditions.forces.push_back({n, 1, -1});
  }
  Topology find(TopologyOptions options) const { return find_topology(model, conditions, options); }
};

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(DensityFilter, KeepsConstantsAndIsTransposed) {
  const fea::Bricks bricks = fea::test::block({5, 4, 3}, {1, 2, 0.5});
  const DensityFilter filter(bricks, 2.1, 1);
  fea::Vector a(bricks.count()), b(bricks.count());
  for (size_t n = 0; n < a.size(); ++n) {
    a[n] = std::sin(static_cast<double>(n));
    b[n] = std::cos(3.0 * static_cast<double>(n));
  }
  for (const double value : filter.apply(fea::Vector(a.size(), 0.3))) EXPECT_NEAR(value, 0.3, 1e-14);
  EXPECT_NEAR(fea::dot(filter.apply(a), b, 1), fea::dot(a, filter.apply_transposed(b), 1), 1e-12);
}

TEST(Topology, IsStifferThanTheSameVolumeEverywhere) {
  TopologyOptions options;
  options.volume_fraction = 0.4;
  options.steps = 60;
  const Topology topology = Bracket().find(options);
  EXPECT_NEAR(mean_of(topology.density), 0.4, 1e-4);
  EXPECT_LT(topology.steps.back().compliance, 0.4 * topology.steps.front().compliance);
}

// Projected densities are nearly all 0 or 1, with the same volume.
TEST(Topology, ProjectionLeavesLittleGrey) {
  TopologyOptions options;
  options.steps = 150;
  const Topology plain = Bracket().find(options);
  options.projection = 16;
  options.projection_steps = 20;
  const Topology sharp = Bracket().find(options);
  EXPECT_NEAR(mean_of(sharp.density), 0.5, 2e-3);
  EXPECT_LT(sharp.steps.back().greyness, 0.3 * plain.steps.back().greyness);
  EXPECT_LT(sharp.steps.back().compliance, 0.5 * sharp.steps.front().compliance);
}

// If the volume fraction is 1, each density is 1.
TEST(Topology, OfAllTheMaterialIsTheSolid) {
  TopologyOptions options;
  options.volume_fraction = 1;
  for (const float density : Bracket().find(options).density) EXPECT_NEAR(density, 1, 1e-5);
}

// A goal at the point and in the direction of the load: the displacement there is the compliance, for a load of 1 N.
TopologyGoal goal_of_load(const Bracket& bracket) { return {bracket.conditions.forces, false}; }

// A goal downwards and along the bracket, at its upper far corner.
TopologyGoal goal_of_corner(const Bracket& bracket) {
  TopologyGoal goal;
  for (uint32_t n = 0; n < bracket.model.bricks.node_count(); ++n)
    if (const Vec3 p = bracket.model.bricks.node(n); p.x == 12 && p.y == 6) {
      goal.unit_forces.push_back({n, 0, 0.3});
      goal.unit_forces.push_back({n, 1, -0.4});
    }
  return goal;
}

TEST(Topology, SlopesAreThoseOfFiniteDifferences) {
  const Bracket bracket;
  TopologyOptions options;
  options.tolerance = 1e-12;
  std::vector<double> density(bracket.model.bricks.count());
  for (size_t n = 0; n < density.size(); ++n) density[n] = 0.6 + 0.3 * std::sin(static_cast<double>(n));
  const auto slopes = [&] { return topology_slopes(bracket.model, bracket.conditions, options, density); };
  for (const bool has_goal : {false, true}) {
    if (has_goal) options.goal = goal_of_corner(bracket);
    const TopologySlopes here = slopes();
    for (const size_t n : {size_t{0}, size_t{7}, size_t{29}, size_t{40}, size_t{71}}) {
      constexpr double step = 1e-4;
      const double at = density[n];
      density[n] = at + step;
      const double above = slopes().value;
      density[n] = at - step;
      const double below = slopes().value;
      density[n] = at;
      const double difference = (above - below) / (2 * step);
      EXPECT_NEAR(here.by_density[n], difference, 1e-5 * std::abs(difference) + 1e-8) << n << ", goal " << has_goal;
    }
  }
}

TEST(Topology, LeastDisplacementAtTheLoadIsLeastCompliance) {
  const Bracket bracket;
  TopologyOptions options;
  options.steps = 30;
  const Topology stiffest = bracket.find(options);
  options.goal = goal_of_load(bracket);
  const Topology stillest = bracket.find(options);
  for (size_t n = 0; n < stiffest.density.size(); ++n) EXPECT_NEAR(stillest.density[n], stiffest.density[n], 1e-3);
  EXPECT_NEAR(stillest.steps.back().compliance, stiffest.steps.back().compliance,
              1e-4 * stiffest.steps.back().compliance);
  EXPECT_NEAR(stillest.steps.back().displacement, stillest.steps.back().compliance,
              1e-9 * stillest.steps.back().compliance);
}

// The goal lies far from the load and along the bracket, where the displacement for equal densities is smaller.
TEST(Topology, GreatestDisplacementGrowsAndLeastFalls) {
  const Bracket bracket;
  TopologyOptions options;
  options.steps = 30;
  options.goal = goal_of_corner(bracket);
  const auto displacements = [&] {
    const Topology topology = bracket.find(options);
    EXPECT_NEAR(topology.steps.back().volume_fraction, 0.5, 1e-3);
    return std::pair(topology.steps.front().displacement, topology.steps.back().displacement);
  };
  const auto [even, least] = displacements();
  EXPECT_LT(least, 0.5 * even);
  options.steps = 6;
  options.goal->is_greatest = true;
  const auto [same, greatest] = displacements();
  EXPECT_DOUBLE_EQ(same, even);
  EXPECT_GT(greatest, 1.5 * even);
}

TEST(Topology, PlacesThatAreHeldAreNoGoals) {
  Bracket bracket;
  TopologyOptions options;
  options.goal = TopologyGoal{{{bracket.conditions.displacements.front().node, 0, 1}}, false};
  EXPECT_THROW(bracket.find(options), Error);
}

TEST(Topology, IsTheSameWithAnyNumberOfThreads) {
  TopologyOptions options;
  options.steps = 10;
  options.threads = 1;
  const std::vector<float> one = Bracket().find(options).density;
  options.threads = 3;
  EXPECT_EQ(Bracket().find(options).density, one);
}

}  // namespace
}  // namespace ombre::optimise
