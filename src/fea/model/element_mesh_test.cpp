#include "fea/model/element_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fea/model/test_element_meshes.h"
#include "fea/model/test_models.h"

namespace ombre::fea {
namespace {

using namespace test;

constexpr std::array<ElementKind, 3> kinds{ElementKind::c3d4, ElementKind::c3d10, ElementKind::c3d8};

TEST(Mesh, ElementsFillTheirBlock) {
  for (const ElementKind kind : kinds) {
    const Mesh mesh = block_of(kind, {2, 3, 4}, {1, 2, 0.5}, 0.1);
    EXPECT_NEAR(MeshView(mesh).total_volume_mm3(), 24, 1e-12);
    EXPECT_EQ(quality_of(mesh).inverted, 0U);
    EXPECT_EQ(MeshView(mesh).bounds(), (Box{{0, 0, 0}, {2, 6, 2}}));
  }
}

// All outer sides look outwards: by the divergence theorem they give the volume, and the sum of their areas is zero.
TEST(Mesh, OuterSidesEncloseTheVolume) {
  for (const ElementKind kind : kinds) {
    const Mesh mesh = block_of(kind, {3, 2, 2}, {1, 1, 2}, 0.1);
    double volume = 0, area = 0;
    Vec3 sum;
    for (const OuterSide& side : outer_sides(mesh)) {
      const Vec3 normal = side_area(mesh, side);
      sum = sum + normal;
      area += length(normal);
      volume += dot(mesh.points[side_nodes(mesh, side)[0]], normal) / 3;
    }
    EXPECT_NEAR(length(sum), 0, 1e-12);
    EXPECT_NEAR(area, 2 * (3 * 2 + 2 * 4 + 3 * 4), 1e-12);
    EXPECT_NEAR(volume, 3 * 2 * 4, 1e-12);
  }
}

TEST(Mesh, BricksHaveTheSameSidesAsHexahedra) {
  const Bricks bricks = block({3, 4, 5}, {1, 2, 3});
  double area = 0;
  for (const OuterSide& side : outer_sides(bricks)) {
    const Vec3 normal = side_area(bricks, side);
    const std::vector<uint32_t> nodes = side_nodes(bricks, side);
    const Vec3 away = bricks.node(nodes[0]) - bricks.centroid(side.element);
    EXPECT_GT(dot(away, normal), 0);
    area += length(normal);
  }
  EXPECT_DOUBLE_EQ(area, 2 * (3 * 8 + 8 * 15 + 3 * 15));
}

TEST(Mesh, MiddleNodesLieInTheMiddleOfTheirEdges) {
  const Mesh mesh = block_of(ElementKind::c3d10, {2, 2, 2}, {1, 1, 1}, 0.1);
  constexpr std::array<std::array<size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  for (size_t n = 0; n < MeshView(mesh).count(); ++n) {
    const auto nodes = MeshView(mesh).nodes(n);
    for (size_t edge = 0; edge < 6; ++edge)
      EXPECT_EQ(mesh.points[nodes[4 + edge]],
                0.5 * (mesh.points[nodes[edges[edge][0]]] + mesh.points[nodes[edges[edge][1]]]));
  }
  // Corners and edges of the cut cubes are counted once.
  EXPECT_EQ(mesh.points.size(), 125U);
}

TEST(Mesh, PiecesHangTogetherAtNodes) {
  EXPECT_EQ(pieces_of(make_bricks({}, {1, 1, 1}, {{0, 0, 0}, {5, 0, 0}, {1, 1, 1}, {6, 0, 1}})),
            (std::vector<uint32_t>{0, 1, 0, 1}));
}

TEST(Mesh, QualityOfARegularAndOfATurnedTetrahedron) {
  const double a = 1 / std::sqrt(2);
  Mesh mesh{ElementKind::c3d4, {{1, 0, -a}, {-1, 0, -a}, {0, 1, a}, {0, -1, a}}, {0, 1, 2, 3}};
  if (MeshView(mesh).volume_mm3(0) < 0) std::swap(mesh.nodes[2], mesh.nodes[3]);
  MeshQuality quality = quality_of(mesh);
  EXPECT_EQ(quality.inverted, 0U);
  EXPECT_NEAR(quality.least_dihedral, std::acos(1.0 / 3) * 180 / 3.14159265358979, 1e-9);
  EXPECT_NEAR(quality.most_dihedral, quality.least_dihedral, 1e-9);
  EXPECT_NEAR(quality.worst_aspect, 1, 1e-12);
  EXPECT_NEAR(quality.mean_edge_mm, 2, 1e-12);
  std::swap(mesh.nodes[0], mesh.nodes[1]);
  EXPECT_EQ(quality_of(mesh).inverted, 1U);
}

}  // namespace
}  // namespace ombre::fea
