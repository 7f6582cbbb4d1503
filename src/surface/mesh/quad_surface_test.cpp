#include "surface/mesh/quad_surface.h"

#include <gtest/gtest.h>

#include <numbers>

#include "surface/mesh/bodies.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr Vec3 middle_of_quads{7.1, 6.8, 7.3};

// The surface of a ball of 5 mm.
struct BallOfQuads : PlainSurface {
  BallOfQuads() : PlainSurface(ball_of(middle_of_quads, 5), corners_from_origin({15, 15, 15}), 0) {}
};

}  // namespace

// Facets whose vertices lie where tangents meet enclose a little more than the ball.
TEST(QuadSurface, OfABallIsClosedAndFacesOutwards) {
  const BallOfQuads ball;
  const RegionSurface built = ball.surface.build();
  EXPECT_EQ(built.report.folded, 0U);
  EXPECT_EQ(ball.surface.quads(), ball.crossings.size());
  for (const Facet& facet : built.facets) {
    const Vec3 a = built.vertices[facet.corners[0]], b = built.vertices[facet.corners[1]],
               c = built.vertices[facet.corners[2]];
    const Vec3 outwards = (1.0 / 3) * (a + b + c) - middle_of_quads;
    EXPECT_GT(dot(cross(b - a, c - a), outwards) * (facet.back == 1 ? 1 : -1), 0);
    EXPECT_EQ(facet.back + facet.front, 1);
  }
  const Body body = body_of(built, 1);
  EXPECT_EQ(body.triangles.size(), 2 * body.vertices.size() - 4) << "Euler, for a surface without holes";
  EXPECT_NEAR(volume_mm3(body) / (4.0 / 3 * std::numbers::pi * 125), 1, 0.02);
}

TEST(QuadSurface, RefreshesTheQuadsAroundWhatMoved) {
  BallOfQuads ball;
  QuadSurface& surface = ball.surface;
  EXPECT_TRUE(surface.refresh().empty());
  const std::vector<uint64_t> before = surface.shape_hashes();
  const uint32_t vertex = 40;
  const Vec3 place = surface.clusters().places()[vertex];
  surface.move(vertex, place + Vec3{0.01, 0, 0});
  const std::vector<uint32_t> changed = surface.refresh();
  const auto around = surface.quads_around(vertex);
  EXPECT_EQ(changed, std::vector<uint32_t>(around.begin(), around.end()));
  for (uint32_t quad = 0; quad < surface.quads(); ++quad)
    EXPECT_EQ(surface.shape_hashes()[quad] == before[quad], !std::ranges::binary_search(changed, quad)) << quad;
  surface.move(vertex, place);
  surface.refresh();
  EXPECT_EQ(surface.shape_hashes(), before);
  surface.place(vertex, place);
  EXPECT_EQ(surface.refresh().size(), surface.quads()) << "after that, all count as changed";
}

TEST(QuadSurface, KnowsWhatIsTurnedOver) {
  BallOfQuads ball;
  QuadSurface& surface = ball.surface;
  EXPECT_TRUE(surface.folded_quads().empty());
  const Vec3 place = surface.clusters().places()[0];
  surface.move(0, 2 * middle_of_quads - place + Vec3{3, 0, 0});
  surface.refresh();
  const std::vector<uint32_t> folded = surface.folded_quads();
  EXPECT_FALSE(folded.empty());
  EXPECT_GT(surface.build().report.folded, 0U);
  const auto around = surface.quads_around(0);
  for (const uint32_t quad : folded) {
    EXPECT_TRUE(surface.is_folded(quad));
    EXPECT_NE(std::ranges::find(around, quad), around.end());
  }
}

}  // namespace ombre::surface
