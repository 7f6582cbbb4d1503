#include "surface/mesh/clusters.h"

#include <gtest/gtest.h>

#include <set>

#include "surface/mesh/bodies.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

const voxel::Lattice small_grid = corners_from_origin({19, 19, 19});

// A block whose faces lie across cells.
Partition some_block() {
  return solid_where_negative([](program::Builder& b) {
    return max(max(abs(b.input(0) - 9.1) - 6.6, abs(b.input(1) - 8.7) - 5.9), abs(b.input(2) - 9.3) - 6.2);
  });
}

std::set<uint32_t> representatives(const PlainSurface& plain) {
  std::set<uint32_t> clusters;
  for (uint32_t vertex = 0; vertex < plain.mesh.vertices.size(); ++vertex)
    clusters.insert(plain.surface.clusters().of(vertex));
  return clusters;
}

}  // namespace

TEST(Clusters, AreNoneWithoutATolerance) {
  const PlainSurface plain(some_block(), small_grid, 0);
  EXPECT_EQ(plain.surface.clusters().size(), plain.mesh.vertices.size());
  for (uint32_t vertex = 0; vertex < plain.mesh.vertices.size(); ++vertex) {
    EXPECT_EQ(plain.surface.clusters().of(vertex), vertex);
    EXPECT_FALSE(plain.surface.clusters().is_joined(vertex));
  }
}

// Some 1200 cells lie at the faces of the block.
TEST(Clusters, OfFlatFacesAreFewAndKeepTheBlock) {
  const PlainSurface plain(some_block(), small_grid, 0.01);
  EXPECT_GT(plain.mesh.vertices.size(), 900U);
  EXPECT_LT(representatives(plain).size(), plain.mesh.vertices.size() / 4);
  const Body body = body_of(plain.surface.build(), 1);
  EXPECT_NEAR(volume_mm3(body), 8 * 6.6 * 5.9 * 6.2, 1e-6);
  EXPECT_NEAR(area_mm2(body), 8 * (6.6 * 5.9 + 5.9 * 6.2 + 6.2 * 6.6), 1e-6);
  EXPECT_EQ(body.triangles.size(), 2 * body.vertices.size() - 4) << "Euler, for a surface without holes";
}

TEST(Clusters, OfABallStayWithinTheTolerance) {
  for (const double tolerance : {0.02, 0.1, 0.4}) {
    const PlainSurface plain(ball_of({9.1, 8.7, 9.3}, 7), small_grid, tolerance);
    const std::set<uint32_t> clusters = representatives(plain);
    for (const uint32_t cluster : clusters)
      EXPECT_NEAR(length(plain.surface.clusters().places()[cluster] - Vec3{9.1, 8.7, 9.3}), 7, tolerance + 0.1);
    const Body body = body_of(plain.surface.build(), 1);
    EXPECT_EQ(body.triangles.size(), 2 * body.vertices.size() - 4);
    if (tolerance > 0.1) {
      EXPECT_LT(clusters.size(), plain.mesh.vertices.size() / 2);
    }
  }
}

TEST(Clusters, ThatAreSplitAreTheirVerticesAgain) {
  PlainSurface plain(some_block(), small_grid, 0.01);
  Clusters clusters = plain.surface.clusters();
  const uint32_t vertices = static_cast<uint32_t>(plain.mesh.vertices.size());
  const auto joined = [&] {
    for (uint32_t vertex = 0; vertex < vertices; ++vertex)
      if (clusters.is_joined(clusters.of(vertex))) return clusters.of(vertex);
    return Cluster::none;
  };
  ASSERT_NE(joined(), Cluster::none);
  for (uint32_t cluster = joined(); cluster != Cluster::none; cluster = joined()) {
    std::set<uint32_t> below;
    for (uint32_t vertex = 0; vertex < vertices; ++vertex)
      if (clusters.of(vertex) == cluster) below.insert(vertex);
    std::vector<uint32_t> changed;
    clusters.split(cluster, changed);
    EXPECT_EQ(std::set<uint32_t>(changed.begin(), changed.end()), below);
    for (const uint32_t vertex : below) EXPECT_LT(clusters[clusters.of(vertex)].level, clusters[cluster].level);
    changed.clear();
    clusters.split(cluster, changed);
    EXPECT_TRUE(changed.empty()) << "it is split already";
  }
  for (uint32_t vertex = 0; vertex < vertices; ++vertex) EXPECT_EQ(clusters.of(vertex), vertex);
}

}  // namespace ombre::surface
