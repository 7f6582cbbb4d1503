#include "optimise/topology.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fea/test_models.h"
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

// Where all material is to be used, there is nothing to find: each density is 1.
TEST(Topology, OfAllTheMaterialIsTheSolid) {
  TopologyOptions options;
  options.volume_fraction = 1;
  for (const float density : Bracket().find(options).density) EXPECT_NEAR(density, 1, 1e-5);
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
