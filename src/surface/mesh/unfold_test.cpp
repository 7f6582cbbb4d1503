#include "surface/mesh/unfold.h"

#include <gtest/gtest.h>

#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr Vec3 middle_of_folds{5.1, 4.8, 5.3};

}  // namespace

TEST(Unfold, MovesAVertexThatLiesBeyondItsNeighbours) {
  PlainSurface plain(ball_of(middle_of_folds, 3), corners_from_origin({11, 11, 11}), 0);
  QuadSurface& surface = plain.surface;
  ASSERT_TRUE(surface.folded_quads().empty());
  const std::vector<Vec3> whole = surface.clusters().places();
  size_t folded = 0;
  for (uint32_t vertex = 0; vertex < plain.mesh.vertices.size(); vertex += 7) {
    // The vertex moves along the surface, over its neighbours.
    const Vec3 before = whole[vertex], radius = before - middle_of_folds;
    const Vec3 aside = cross(radius, {0.6, 0.64, 0.48});
    surface.move(vertex, before + (1.5 / length(aside)) * aside);
    surface.refresh();
    folded += surface.folded_quads().empty() ? 0 : 1;
    unfold(surface);
    EXPECT_TRUE(surface.folded_quads().empty()) << vertex;
    for (uint32_t n = 0; n < whole.size(); ++n) surface.move(n, whole[n]);
  }
  EXPECT_GT(folded, 5U);
}

TEST(Unfold, LeavesOtherVerticesWhereTheyAre) {
  PlainSurface plain(ball_of(middle_of_folds, 3), corners_from_origin({11, 11, 11}), 0);
  const std::vector<Vec3> before = plain.surface.clusters().places();
  unfold(plain.surface);
  EXPECT_EQ(plain.surface.clusters().places(), before);
}

}  // namespace ombre::surface
