#include "jobs/fea/tetra_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/text/error.h"
#include "base/text/json.h"
#include "jobs/fea/fea_selection.h"
#include "jobs/fea/sharp_edges.h"
#include "jobs/test_designs.h"
#include "solids/tetrahedra.h"

namespace ombre::compile {
namespace {

LoadedPtr design_of(const std::string& text) {
  Diagnostics diagnostics;
  auto loaded = load_text(text, diagnostics);
  EXPECT_TRUE(loaded) << to_text(diagnostics);
  return loaded;
}

fea::Study any_study() {
  fea::Study study;
  study.materials = {{"red", {1000, 0.3, 0}}, {"blue", {10, 0.3, 0}}};
  return study;
}

std::optional<TetraModel> tetrahedra_of(const LoadedPtr& loaded, const TetraRequest& request) {
  Diagnostics diagnostics;
  auto made = tetra_model(loaded, any_study(), request, diagnostics);
  EXPECT_TRUE(made) << to_text(diagnostics);
  return made;
}

TetraRequest of_size(double size_mm) {
  TetraRequest request;
  request.size = {size_mm, size_mm, ""};
  return request;
}

class Tetra : public testing::Test {
 protected:
  void SetUp() override {
    if (!solids::has_tetrahedra()) GTEST_SKIP() << "there is no mesher in this build";
  }
};

// The edges and corners of a cube are kept: its volume is exact, and all of its eight corners are nodes.
TEST_F(Tetra, SharpEdgesAreKept) {
  const auto made = tetrahedra_of(design_of("rectprism((10, 10, 10), red);"), of_size(2.5));
  ASSERT_TRUE(made);
  EXPECT_NEAR(fea::MeshView(made->model.mesh).total_volume_mm3(), 1000, 0.01);
  EXPECT_EQ(made->quality.inverted, 0U);
  EXPECT_GT(made->quality.least_dihedral, 5);
  EXPECT_NEAR(made->quality.mean_edge_mm, 2.5, 0.5);
  size_t corners = 0;
  for (const Vec3& p : made->model.mesh.points)
    if (std::abs(std::abs(p.x) - 5) + std::abs(std::abs(p.y) - 5) + std::abs(std::abs(p.z) - 5) < 1e-3) ++corners;
  EXPECT_EQ(corners, 8U);
}

// The upper of two cubes is turned by 30 degrees: their edges cross 0.03 mm apart.
TEST_F(Tetra, EdgesThatLieTooCloseAreLeftOut) {
  const LoadedPtr loaded = design_of(
      "union() { rectprism((10, 10, 10), red); translate(0, 0, 0.03) rotate(0, 0, 30) rectprism((10, 10, 10), red); }");
  Diagnostics diagnostics;
  const auto made = tetra_model(loaded, any_study(), of_size(2.5), diagnostics);
  ASSERT_TRUE(made) << to_text(diagnostics);
  EXPECT_NE(to_text(diagnostics).find("sharp edges are cut off, since others lie too close"), std::string::npos)
      << to_text(diagnostics);
  // The common area of two squares of side s turned by t is s^2 * 2 / (1 + sin t + cos t).
  const double common = 100 * 2 / (1 + std::sin(std::numbers::pi / 6) + std::cos(std::numbers::pi / 6));
  const double wanted = 2000 - 9.97 * common;
  EXPECT_NEAR(made->surface_mm3, wanted, 0.001 * wanted);
  EXPECT_NEAR(fea::MeshView(made->model.mesh).total_volume_mm3(), wanted, 0.03 * wanted);
  EXPECT_EQ(made->quality.inverted, 0U);
}

// A plate half as thick as elements are large keeps its length, width and thickness, to its corners.
TEST_F(Tetra, ThinPlatesKeepTheirEdges) {
  const LoadedPtr loaded = design_of("rectprism((20, 4, 1), red);");
  Diagnostics diagnostics;
  const auto made = tetra_model(loaded, any_study(), of_size(2), diagnostics);
  ASSERT_TRUE(made) << to_text(diagnostics);
  EXPECT_NEAR(fea::MeshView(made->model.mesh).total_volume_mm3(), 80, 0.01);
  size_t corners = 0;
  for (const Vec3& p : made->model.mesh.points)
    if (std::abs(std::abs(p.x) - 10) + std::abs(std::abs(p.y) - 2) + std::abs(std::abs(p.z) - 0.5) < 1e-3) ++corners;
  EXPECT_EQ(corners, 8U);
  EXPECT_EQ(to_text(diagnostics).find("cut off"), std::string::npos) << to_text(diagnostics);
}

// Round surfaces that are separate, or one inside of another, are all found.
TEST_F(Tetra, SmoothSurfacesAreAllFound) {
  const auto made = tetrahedra_of(
      design_of("union() { sphere(3, red); translate(12, 0, 0) difference() { sphere(5, red); sphere(3, red); } }"),
      of_size(1));
  ASSERT_TRUE(made);
  const double wanted = 4.0 / 3 * std::numbers::pi * (27 + 125 - 27);
  EXPECT_NEAR(fea::MeshView(made->model.mesh).total_volume_mm3(), wanted, 0.04 * wanted);
  EXPECT_NEAR(made->surface_mm3, wanted, 0.01 * wanted);
}

TEST_F(Tetra, TheSameBytesWithAnyThreads) {
  const LoadedPtr loaded = design_of(
      R"(fgrade(["0.5 + x/10", "0.5 - x/10"], [red, blue]) { difference() { rectprism((10, 6, 6), red); sphere(2, red); } })");
  TetraRequest request = of_size(1.5);
  request.sections.threads = 1;
  const auto one = tetrahedra_of(loaded, request);
  request.sections.threads = 4;
  const auto four = tetrahedra_of(loaded, request);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->model.mesh.points, four->model.mesh.points);
  EXPECT_EQ(one->model.mesh.nodes, four->model.mesh.nodes);
  EXPECT_EQ(one->model.section_of, four->model.section_of);
}

// Red is drawn with the odds x / 10 + 0.5, so its share in each half is the mean there; another seed draws others.
TEST_F(Tetra, MixturesAreDrawnByTheirFractions) {
  const LoadedPtr loaded =
      design_of(R"(fgrade(["0.5 + x/10", "0.5 - x/10"], [red, blue]) { rectprism((10, 10, 10), red); })");
  TetraRequest request = of_size(0.8);
  const auto made = tetrahedra_of(loaded, request);
  ASSERT_TRUE(made);
  const fea::MeshView mesh(made->model.mesh);
  ASSERT_EQ(made->model.fields[0].name, "fraction of red");
  double red = 0, wanted = 0, variance = 0;
  for (size_t n = 0; n < mesh.count(); ++n) {
    const double share = 0.5 + mesh.centroid(n).x / 10;
    EXPECT_NEAR(made->model.fields[0].values[n], share, 1e-6);
    red += made->model.sections[made->model.section_of[n]].name == "red" ? 1 : 0;
    wanted += share;
    variance += share * (1 - share);
  }
  EXPECT_NEAR(red, wanted, 4 * std::sqrt(variance));
  request.seed = 7;
  EXPECT_NE(tetrahedra_of(loaded, request)->model.section_of, made->model.section_of);
}

// Elements are small where shares are equal, and large where there is one material (Eq. 1).
TEST_F(Tetra, SizesFollowTheirFormula) {
  TetraRequest request;
  request.size = {0.6, 3, "min_cell + h*(max_cell - min_cell)"};
  const auto made = tetrahedra_of(
      design_of(R"(fgrade(["0.5 + x/20", "0.5 - x/20"], [red, blue]) { rectprism((20, 5, 5), red); })"), request);
  ASSERT_TRUE(made);
  const fea::MeshView mesh(made->model.mesh);
  double middle = 0, ends = 0;
  for (size_t n = 0; n < mesh.count(); ++n) {
    if (std::abs(mesh.centroid(n).x) < 1) ++middle;
    if (std::abs(mesh.centroid(n).x) > 9) ++ends;
  }
  EXPECT_GT(middle, 10 * ends);
}

// Borders between materials are faces: each element lies on one side, and the volumes are exact.
TEST_F(Tetra, SubdomainsMeetInFaces) {
  TetraRequest request = of_size(1.5);
  request.by_material = true;
  request.quadratic = true;
  const auto made = tetrahedra_of(
      design_of("union() { translate(2.5, 0, 0) rectprism((5, 6, 6), red); translate(-2, 0, 0) rectprism((4, 6, 6), "
                "blue); }"),
      request);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->model.mesh.kind, fea::ElementKind::c3d10);
  const fea::MeshView mesh(made->model.mesh);
  double red = 0;
  for (size_t n = 0; n < mesh.count(); ++n) {
    const bool is_red = made->model.sections[made->model.section_of[n]].name == "red";
    EXPECT_EQ(is_red, mesh.centroid(n).x > 0);
    if (is_red) red += mesh.volume_mm3(n);
  }
  EXPECT_NEAR(red, 180, 0.2);
}

TEST_F(Tetra, WhatIsWrongIsReported) {
  const LoadedPtr loaded = design_of("rectprism((10, 10, 10), red);");
  TetraRequest request = of_size(0.01);
  request.memory_bytes = size_t{1} << 30;
  Diagnostics diagnostics;
  EXPECT_THROW(tetra_model(loaded, any_study(), request, diagnostics), Error);
  request.size = {1, 2, "min_cell + k"};
  EXPECT_FALSE(tetra_model(loaded, any_study(), request, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("\"k\""), std::string::npos) << to_text(diagnostics);
  StopFlag stop;
  stop.request();
  EXPECT_THROW(tetra_model(loaded, any_study(), of_size(0.5), diagnostics, nullptr, &stop), Cancelled);
}

// A cube of twelve triangles has twelve sharp edges; the diagonals are none.
TEST(SharpEdges, OfACube) {
  surface::Body cube;
  for (int n = 0; n < 8; ++n) cube.vertices.push_back({n & 1 ? 1.0 : 0.0, n & 2 ? 1.0 : 0.0, n & 4 ? 1.0 : 0.0});
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const SharpEdges edges = find_sharp_edges({cube, cube}, 1e-3, 1);
  EXPECT_EQ(edges.lines.size(), 12U);
  for (const auto& line : edges.lines) {
    ASSERT_EQ(line.size(), 2U);
    EXPECT_NEAR(length(line[1] - line[0]), 1, 1e-12);
  }
  EXPECT_TRUE(edges.smooth_points.empty());
}

// Formulas and parts choose nodes by the design.
TEST(FeaSelection, ByFormulaAndPart) {
  const LoadedPtr loaded = design_of(
      R"(part("left") translate(-2, 0, 0) rectprism((4, 4, 4), red); part("right") translate(2, 0, 0) rectprism((4, 4, 4), blue);)");
  ASSERT_TRUE(loaded);
  const fea::Mesh mesh{fea::ElementKind::c3d4,
                       {{-4, 0, 0}, {-1, 0, 0}, {-3, 1, 0}, {-3, 0, 1}, {4, 0, 0}, {3, 1, 0}, {3, 0, 1}, {1, 0, 0}},
                       {0, 1, 2, 3, 7, 4, 5, 6}};
  const auto choose = node_chooser(*loaded, mesh, 1, nullptr);
  const auto chosen = [&](const fea::Selection& selection) {
    Diagnostics diagnostics;
    const auto nodes = choose(selection, diagnostics);
    EXPECT_TRUE(nodes) << to_text(diagnostics);
    std::string text;
    for (const bool is_chosen : nodes.value_or(std::vector<bool>{})) text += is_chosen ? '1' : '0';
    return text;
  };
  fea::Selection selection;
  selection.formula = {"x > 0 && z < 0.5", {}};
  EXPECT_EQ(chosen(selection), "00001101");
  selection.formula.reset();
  selection.part = {"left", {}};
  EXPECT_EQ(chosen(selection), "11110000");
  selection.part = {"lfet", {}};
  Diagnostics diagnostics;
  EXPECT_FALSE(choose(selection, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("did you mean \"left\"?"), std::string::npos);
}

}  // namespace
}  // namespace ombre::compile
