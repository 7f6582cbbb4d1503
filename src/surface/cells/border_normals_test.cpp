#include "surface/cells/border_normals.h"

#include <gtest/gtest.h>

#include <random>

#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr Vec3 flat_cell{1, 0.5, 0.25};

// Returns the normals where edges from points inside cross the border of a region, along the axis with the greatest
// component of the outward direction.
std::vector<Vec3> normals_of(const Partition& partition, const std::vector<std::pair<Vec3, Vec3>>& edges, Label from,
                             Label to) {
  PointEvaluator evaluator;
  evaluator.begin(partition, partition.details.whole());
  std::vector<EdgeSearch> searches;
  for (const auto& [start, along] : edges) {
    EdgeSearch& search = searches.emplace_back();
    search.start = start;
    search.along = along;
    search.from = from;
    search.to = to;
  }
  search_edges(searches, evaluator);
  return border_normals(searches, flat_cell, evaluator);
}

}  // namespace

TEST(BorderNormals, OfABallAreItsRadii) {
  const Partition ball = ball_of({0, 0, 0}, 5);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<std::pair<Vec3, Vec3>> outwards, inwards;
  std::vector<Vec3> radii;
  for (int n = 0; n < 60; ++n) {
    Vec3 radius{any(random), any(random), any(random)};
    radius = (1 / length(radius)) * radius;
    const int axis = n % 3;
    Vec3 along;
    along[axis] = radius[axis] > 0 ? flat_cell[axis] : -flat_cell[axis];
    if (std::abs(radius[axis]) < 0.3) continue;
    radii.push_back(radius);
    outwards.emplace_back(5 * radius - 0.4 * along, along);
    inwards.emplace_back(5 * radius + 0.6 * along, -along);
  }
  const auto out = normals_of(ball, outwards, 1, 0), in = normals_of(ball, inwards, 0, 1);
  ASSERT_GT(radii.size(), 20U);
  for (size_t n = 0; n < radii.size(); ++n) {
    EXPECT_LT(length(out[n] - radii[n]), 1e-6);
    EXPECT_LT(length(in[n] + radii[n]), 1e-6);
  }
}

// No value separates the regions, or one that jumps: the slope of the border is measured.
TEST(BorderNormals, OfJumpsAreThoseOfTheBorder) {
  using program::Builder;
  const Vec3 normal{0.36, 0.48, 0.8};
  const auto height = [&](Builder& b) { return b.input(0) * normal.x + b.input(1) * normal.y + b.input(2) * normal.z; };
  for (const double jump : {0.0, 1.0}) {
    Builder builder;
    const auto label = select(height(builder) < 0, builder.constant(1), builder.constant(0));
    Partition partition;
    partition.label = builder.finish({{"region", label}});
    partition.details = LocalPrograms(
        builder.finish({{"region", label},
                        {"distance", select(height(builder) < 0, builder.constant(-jump), builder.constant(jump))}}),
        Box::centered({10, 10, 10}));
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 along;
      along[axis] = flat_cell[axis];
      const auto found = normals_of(partition, {{-0.4 * along, along}}, 1, 0);
      EXPECT_LT(length(found[0] - normal), 1e-4) << jump << " " << axis;
    }
  }
}

}  // namespace ombre::surface
