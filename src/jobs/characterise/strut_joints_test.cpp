// Tests the graphs of struts, whose joints and lengths were found with pencil and paper.
#include "jobs/characterise/strut_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ombre::compile {
namespace {

using Degrees = std::map<size_t, size_t>;

void expect_graph(const StrutGraph& graph, size_t joints, size_t struts, const Degrees& degrees) {
  EXPECT_EQ(graph.joints, joints);
  EXPECT_EQ(graph.struts, struts);
  EXPECT_EQ(graph.joints_of_degree, degrees);
}

// Lines along x and along y at whole numbers that begin 1 mm before the first and end 1 mm behind the last.
std::vector<GraphStrut> grid_of_lines(int columns, int rows) {
  std::vector<GraphStrut> struts;
  for (double x = 0; x < columns; ++x) struts.push_back({{x, -1, 0}, {x, 1.0 * rows, 0}, 0.1});
  for (double y = 0; y < rows; ++y) struts.push_back({{-1, y, 0}, {1.0 * columns, y, 0}, 0.1});
  return struts;
}

}  // namespace

TEST(StrutJoints, AreWhereStrutsCross) {
  expect_graph(graph_of({{{-5, 0, 0}, {5, 0, 0}}, {{0, -5, 0}, {0, 5, 0}}, {{0, 0, -5}, {0, 0, 5}}}), 7, 6,
               {{1, 6}, {6, 1}});
  const StrutGraph graph = graph_of(grid_of_lines(40, 30));
  expect_graph(graph, 40 * 30 + 2 * (40 + 30), 40 * 31 + 30 * 41, {{1, 2 * (40 + 30)}, {4, 40 * 30}});
  EXPECT_NEAR(graph.length.least, 1, 1e-12);
  EXPECT_NEAR(graph.length.greatest, 1, 1e-12);
  EXPECT_NEAR(graph.slenderness.mean, 20, 1e-9);
}

TEST(StrutJoints, AreWhereAStrutEndsOnAnother) {
  const StrutGraph graph = graph_of({{{-5, 0, 0}, {5, 0, 0}}, {{0, 0, 0}, {0, 5, 0}}});
  expect_graph(graph, 4, 3, {{1, 3}, {3, 1}});
  EXPECT_NEAR(graph.length.greatest, 5, 1e-12);
  // An L has no joint in the middle of a strut, but one at its corner.
  expect_graph(graph_of({{{-5, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 5, 0}}}), 3, 2, {{1, 2}, {2, 1}});
}

TEST(StrutJoints, ShareWhatOverlaps) {
  const std::vector<GraphStrut> overlapping{{{0, 0, 0}, {4, 2, 0}, 0.1}, {{6, 3, 0}, {2, 1, 0}, 0.5}};
  const StrutGraph graph = graph_of(overlapping);
  expect_graph(graph, 2, 1, {{1, 2}});
  EXPECT_NEAR(graph.length.mean, std::sqrt(45), 1e-12);
  EXPECT_NEAR(graph.slenderness.mean, 2 * std::sqrt(45) / 0.1, 1e-9);
  // The thickest of equal struts counts.
  for (const auto& [first, second] : {std::pair(0.1, 0.5), std::pair(0.5, 0.1)}) {
    const StrutGraph same = graph_of({{{0, 0, 0}, {4, 0, 0}, first}, {{4, 0, 0}, {0, 0, 0}, second}});
    expect_graph(same, 2, 1, {{1, 2}});
    EXPECT_DOUBLE_EQ(same.slenderness.mean, 16);
  }
}

TEST(StrutJoints, HaveATolerance) {
  const auto crossed_at = [](double height) {
    return graph_of({{{-5, 0, 0}, {5, 0, 0}}, {{0, -5, height}, {0, 5, height}}}).joints;
  };
  EXPECT_EQ(crossed_at(0), 5u);
  EXPECT_EQ(crossed_at(0.9 * 10 * same_joint), 5u);
  EXPECT_EQ(crossed_at(4 * 10 * same_joint), 4u);
  const auto ending_at = [](double x) { return graph_of({{{-5, 0, 0}, {5, 0, 0}}, {{x, 0, 0}, {x, 9, 0}}}).joints; };
  EXPECT_EQ(ending_at(5), 3u);
  EXPECT_EQ(ending_at(5 - 0.5e-5), 3u);
  EXPECT_EQ(ending_at(5 - 1e-3), 4u);
}

TEST(StrutJoints, LieOnTheBordersOfPeriods) {
  // A strut across the border, and one along it on the other side.
  const StrutGraph graph = graph_of({{{3, 2, 0}, {5, 2, 0}}, {{0, 1, 0}, {0, 3, 0}}}, {4, 4, 0});
  expect_graph(graph, 5, 4, {{1, 4}, {4, 1}});
  // Half struts on both sides of a border.
  const StrutGraph joined = graph_of({{{0, 1, 1}, {1, 1, 1}}, {{4, 1, 1}, {2, 1, 1}}}, {4, 4, 4});
  expect_graph(joined, 2, 1, {{1, 2}});
  EXPECT_NEAR(joined.length.mean, 3, 1e-12);
  // Rounding moves an end across the border.
  for (const double x : {-1e-15, 0.0, 1e-15, 4 - 1e-15, 4.0})
    expect_graph(graph_of({{{x, 0, 0}, {x, 2, 0}}, {{0, 0, 0}, {2, 0, 0}}}, {4, 4, 4}), 3, 2, {{1, 2}, {2, 1}});
  // A strut twice as long as its period crosses two copies of another.
  expect_graph(graph_of({{{0, 0, 0}, {8, 1, 0}}, {{2, -1, 0}, {2, 2, 0}}}, {4, 0, 0}), 6, 6, {{1, 4}, {4, 2}});
}

TEST(StrutJoints, StandForLinesThatClose) {
  const StrutGraph straight = graph_of({{{0, 3, 3}, {6, 3, 3}, 0.5}}, {6, 6, 6});
  expect_graph(straight, 1, 1, {{2, 1}});
  EXPECT_DOUBLE_EQ(straight.length.mean, 6);
  EXPECT_DOUBLE_EQ(straight.slenderness.mean, 24);
  const StrutGraph in_pieces = graph_of({{{0, 3, 3}, {2, 3, 3}}, {{2, 3, 3}, {6, 3, 3}}}, {6, 6, 6});
  expect_graph(in_pieces, 1, 1, {{2, 1}});
  EXPECT_NEAR(in_pieces.length.mean, 6, 1e-12);
  // A line that closes after two rounds along x and one along y.
  const StrutGraph wound = graph_of({{{0, 0, 0}, {6, 3, 0}}, {{0, 3, 0}, {6, 6, 0}}}, {6, 6, 6});
  expect_graph(wound, 1, 1, {{2, 1}});
  EXPECT_NEAR(wound.length.mean, 2 * std::sqrt(45), 1e-12);
  // Beside it, lines with joints stay as they are: a plane of squares.
  expect_graph(graph_of({{{0, 3, 3}, {6, 3, 3}}, {{0, 0, 0}, {6, 0, 0}}, {{0, 0, 0}, {0, 6, 0}}}, {6, 6, 6}), 2, 3,
               {{2, 1}, {4, 1}});
}

TEST(StrutJoints, KeepTheirGraphWhereLengthsChange) {
  const std::vector<GraphStrut> corner{{{0, 0, 0}, {6, 0, 0}}, {{0, 0, 0}, {0, 0, 6}}};
  const StrutGraph graph = graph_of(corner, {}, Affine::scaling({1, 1, 2}));
  expect_graph(graph, 3, 2, {{1, 2}, {2, 1}});
  EXPECT_DOUBLE_EQ(graph.length.least, 6);
  EXPECT_DOUBLE_EQ(graph.length.greatest, 12);
}

// Struts between random whole places overlap and cross in many ways.
TEST(StrutJoints, DependNeitherOnTheFrameNorOnTheCell) {
  std::mt19937 random(7);
  const auto place = [&] {
    const auto whole = [&] { return static_cast<double>(random() % 5); };
    return Vec3{whole(), whole(), whole()};
  };
  const Affine turn = Affine::translation({0.1, 0.2, 0.3}) * Affine::rotation({1, 2, 3}, 40);
  const Vec3 period{4, 4, 4};
  for (int n = 0; n < 200; ++n) {
    std::vector<GraphStrut> struts, turned, moved, twice;
    for (int m = 0; m < 6; ++m) {
      const Vec3 a = place(), b = place(), by{4.0 * m, 0, -4};
      struts.push_back({a, b});
      turned.push_back({turn(b), turn(a)});
      moved.push_back({a + by + Vec3{0.1, 0.2, 0.3}, b + by + Vec3{0.1, 0.2, 0.3}});
      for (const double x : {0, 4}) twice.push_back({a + Vec3{x, 0, 0}, b + Vec3{x, 0, 0}});
    }
    const StrutGraph alone = graph_of(struts), same = graph_of(turned);
    expect_graph(same, alone.joints, alone.struts, alone.joints_of_degree);
    const StrutGraph cell = graph_of(struts, period), shifted = graph_of(moved, period);
    expect_graph(shifted, cell.joints, cell.struts, cell.joints_of_degree);
    StrutGraph both = graph_of(twice, {8, 4, 4});
    const auto total = [](const StrutGraph& graph) { return graph.length.mean * static_cast<double>(graph.struts); };
    EXPECT_NEAR(total(both), 2 * total(cell), 1e-9);
    // Lines that close have a joint in each cell, however large, which has the degree 2.
    for (const auto& [degree, joints] : cell.joints_of_degree) {
      if (degree == 2) continue;
      EXPECT_EQ(both.joints_of_degree[degree], 2 * joints);
    }
  }
}

TEST(StrutJoints, AreNoneWithoutStruts) {
  expect_graph(graph_of({}), 0, 0, {});
  expect_graph(graph_of({{{1, 1, 1}, {1, 1, 1}}}, {2, 2, 2}), 0, 0, {});
}

}  // namespace ombre::compile
