#include "surface/outline/outline_crossings.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "program/evaluate.h"
#include "surface/outline/outline_simplify.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

using program::Builder;
using program::Field;

const voxel::Lattice layer_corners = corners_from_origin({21, 21, 5});

// Returns the graph of a layer with its crossings and vertices in their places.
OutlineGraph placed_graph(const Partition& partition, int64_t k) {
  CornerLabels labels{21, 21, std::vector<Label>(size_t{21} * 21)};
  std::vector<double> values;
  for (int32_t j = 1; j < 20; ++j)
    for (int32_t i = 1; i < 20; ++i) {
      program::evaluate_point(partition.label, layer_corners.center(i, j, k), values);
      labels.labels[static_cast<size_t>(j * 21 + i)] = static_cast<Label>(values[partition.label.outputs[0]]);
    }
  OutlineGraph graph = trace_cells(labels);
  find_outline_crossings(partition, layer_corners, k, graph);
  place_outline_vertices(layer_corners, graph);
  return graph;
}

// A cone around (9.7, 10.2) whose radius at a height z is 8 - z.
Partition cone() {
  return solid_where_negative([](Builder& b) { return length(b.input(0) - 9.7, b.input(1) - 10.2) - 8 + b.input(2); });
}

}  // namespace

TEST(OutlineCrossings, LieOnTheCircleOfTheirLayer) {
  for (const int64_t k : {1, 3}) {
    const double radius = 8 - static_cast<double>(k);
    const OutlineGraph graph = placed_graph(cone(), k);
    EXPECT_EQ(graph.crossings.size(), 8 * radius) << "both ends of 2 r lines along x and along y";
    for (const OutlineCrossing& crossing : graph.crossings) {
      const Vec2 from_middle = crossing.at - Vec2{9.7, 10.2};
      EXPECT_NEAR(length(from_middle), radius, 1e-7);
      // In the plane, the normal points along the radius although the border leans.
      const double outwards = crossing.from == 1 ? 1 : -1;
      EXPECT_LT(length(crossing.normal - (outwards / radius) * from_middle), 1e-6);
    }
    // Where tangents at a diagonal's distance d meet, or halfway between their points, is d^2 / (8 r) from the circle.
    for (const OutlineVertex& vertex : graph.vertices)
      EXPECT_NEAR(length(vertex.at - Vec2{9.7, 10.2}), radius, 2 / (8 * radius) + 0.01);
  }
}

TEST(OutlineCrossings, CornersAreWhereTheirSidesMeet) {
  // A square around (9.7, 10.2), turned so that no side runs along the grid.
  constexpr double c = 0.8, s = 0.6, half = 5.3;
  const Partition square_prism = solid_where_negative([](Builder& b) {
    const Field x = b.input(0) - 9.7, y = b.input(1) - 10.2;
    return max(abs(x * c + y * s) - half, abs(y * c - x * s) - half);
  });
  const OutlineGraph graph = placed_graph(square_prism, 2);
  for (const Vec2 corner : {Vec2{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const Vec2 at{9.7 + half * (c * corner.x - s * corner.y), 10.2 + half * (s * corner.x + c * corner.y)};
    double nearest = 1;
    for (const OutlineVertex& vertex : graph.vertices) nearest = std::min(nearest, length(vertex.at - at));
    EXPECT_LT(nearest, 1e-6) << corner.x << " " << corner.y;
  }
}

// Two crossings of the cell from (2, 3) to (3, 4), with borders that meet in a point.
TEST(OutlineCrossings, VerticesHaveOtherPlacesToGo) {
  OutlineGraph graph;
  graph.crossings.resize(2);
  graph.crossings[0].at = {2.25, 3};
  graph.crossings[0].normal = {1, 0};
  graph.crossings[1].at = {2, 3.5};
  graph.crossings[1].normal = {0, 1};
  OutlineVertex vertex{2, 3, 2, {0, 1, 0, 0}, {}};
  EXPECT_EQ(mean_point(graph, vertex), (Vec2{2.125, 3.25}));
  vertex.at = {2.25, 3.5};
  EXPECT_TRUE(is_in_cell(layer_corners, vertex));
  vertex.at = {1.99, 3.5};
  EXPECT_FALSE(is_in_cell(layer_corners, vertex));
  // The borders meet at (2.25, 3.5), nearest to the side x = 2.
  const Vec2 on_cell = point_on_cell(layer_corners, graph, vertex);
  EXPECT_NEAR(on_cell.x, 2, 1e-12);
  EXPECT_NEAR(on_cell.y, 3.5, 1e-12);
}

// Borders that meet far away have no corner in this cell.
TEST(OutlineCrossings, VerticesStayNearTheirCells) {
  OutlineGraph graph;
  graph.crossings.resize(2);
  graph.crossings[0].at = {2, 3.4};
  graph.crossings[0].normal = {0.6, -0.8};
  graph.crossings[1].at = {2, 3.6};
  graph.crossings[1].normal = {0.573, -0.8195526828};
  graph.vertices.push_back({2, 3, 2, {0, 1, 0, 0}, {}});
  place_outline_vertices(layer_corners, graph);
  const Vec2 at = graph.vertices[0].at;
  EXPECT_GE(at.x, 0);
  EXPECT_LE(at.x, 5);
  EXPECT_GE(at.y, 1);
  EXPECT_LE(at.y, 6);
}

TEST(OutlineCrossings, StopOnRequest) {
  OutlineGraph graph = placed_graph(cone(), 1);
  StopFlag stop;
  stop.request();
  EXPECT_THROW(find_outline_crossings(cone(), layer_corners, 1, graph, &stop), Cancelled);
}

}  // namespace ombre::surface
