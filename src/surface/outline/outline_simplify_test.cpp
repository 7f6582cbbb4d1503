#include "surface/outline/outline_simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/outline/outline_overlaps.h"

namespace ombre::surface {
namespace {

// Adds a ring of vertices around the origin, and returns its chain.
OutlineChain add_ring(OutlineGraph& graph, int count, double radius) {
  OutlineChain ring{1, 0, {}};
  for (int n = 0; n < count; ++n) {
    const double angle = 2 * std::numbers::pi * n / count;
    ring.nodes.push_back(static_cast<uint32_t>(graph.vertices.size()));
    graph.vertices.push_back({0, 0, 2, {}, {radius * std::cos(angle), radius * std::sin(angle)}});
  }
  ring.nodes.push_back(ring.nodes.front());
  return ring;
}

double distance_to_side(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return length(p - a - t * along);
}

double distance_to_chain(const OutlineGraph& graph, uint32_t node, const OutlineChain& chain) {
  double nearest = 1e9;
  for (size_t n = 0; n + 1 < chain.nodes.size(); ++n)
    nearest = std::min(nearest, distance_to_side(point_of(graph, node), point_of(graph, chain.nodes[n]),
                                                 point_of(graph, chain.nodes[n + 1])));
  return nearest;
}

}  // namespace

// A chord of a circle of radius r that is off by the tolerance t spans an angle of 2 acos(1 - t / r).
TEST(OutlineSimplify, RingsKeepAsFewPointsAsTheToleranceAllows) {
  for (const double tolerance : {0.3, 0.03, 0.003}) {
    OutlineGraph graph;
    const OutlineChain ring = add_ring(graph, 1000, 10);
    const std::vector<OutlineChain> made = simplify(graph, {ring}, tolerance);
    ASSERT_EQ(made.size(), 1U);
    EXPECT_TRUE(made[0].is_closed());
    for (const uint32_t node : ring.nodes) EXPECT_LE(distance_to_chain(graph, node, made[0]), tolerance + 1e-12);
    // Halving takes at most twice as many points as the best polygon.
    const double fewest = std::numbers::pi / std::acos(1 - tolerance / 10);
    const auto kept = static_cast<double>(made[0].nodes.size() - 1);
    EXPECT_GE(kept, 0.98 * fewest);
    EXPECT_LE(kept, 2 * fewest + 2);
  }
}

TEST(OutlineSimplify, RingsSmallerThanTheToleranceStay) {
  OutlineGraph graph;
  const OutlineChain ring = add_ring(graph, 12, 0.1);
  const std::vector<OutlineChain> made = simplify(graph, {ring}, 5);
  EXPECT_GE(made[0].nodes.size(), 4U);
  EXPECT_TRUE(made[0].is_closed());
}

TEST(OutlineSimplify, RingsInEachOtherDoNotMeet) {
  OutlineGraph graph;
  const OutlineChain outer = add_ring(graph, 200, 10), inner = add_ring(graph, 137, 9.9);
  ASSERT_TRUE(find_overlaps(graph, {outer, inner}).empty());
  const std::vector<OutlineChain> made = simplify(graph, {outer, inner}, 1);
  EXPECT_TRUE(find_overlaps(graph, made).empty());
  EXPECT_LT(made[0].nodes.size() + made[1].nodes.size(), outer.nodes.size() + inner.nodes.size());
}

}  // namespace ombre::surface
