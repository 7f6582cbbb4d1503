#include "fea/solve/stresses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/text/json.h"
#include "fea/model/study.h"
#include "fea/model/test_models.h"

namespace ombre::fea {
namespace {

using namespace test;

double greatest_at_nodes(const Stresses& stresses) {
  double greatest = 0;
  for (const auto& stress : stresses.at_nodes_mpa) greatest = std::max(greatest, von_mises(stress));
  return greatest;
}

// A strip of 20 x 4 x 1 mm under 1 N at its end has 6 F L / (b h^2) = 30 MPa on the surface at its root, whatever the
// bricks. With one brick across there is no stress in the middles; at integration points it is 1/sqrt(3) of that, less
// half a brick of the length.
TEST(Stresses, StripsHaveTheirStressOnTheSurface) {
  for (const double brick_mm : {2.0, 1.0, 0.8, 0.5}) {
    const Model model = model_of(cut_block({20, 4, 1}, brick_mm), {1000, 0});
    Diagnostics diagnostics;
    const auto data = parse_json(make_source("strip.json", R"({
        "supports": [{"on": "xmin", "fix": "xyz"}], "loads": [{"on": "xmax", "force_n": [0, 0, -1]}]})"),
                                 diagnostics);
    const auto conditions = conditions_of(*read_study(*data, diagnostics), model, diagnostics);
    const Stresses stresses = stresses_of(model, solve(model, *conditions, {1e-10, 20000, 2}));
    EXPECT_NEAR(greatest_at_nodes(stresses), 30, 0.06 * 30) << brick_mm;
    if (brick_mm >= 1) {
      EXPECT_NEAR(*std::ranges::max_element(stresses.greatest_at_points_mpa), 30 / std::sqrt(3.0), 0.06 * 30);
    }
  }
}

// Two materials lie side by side and are strained alike: each has its own stress, and where they meet the greater one
// counts.
TEST(Stresses, MaterialsAreNotAveraged) {
  Model model{block({4, 2, 2}, {1, 1, 1}), {{"rigid", {1000, 0}}, {"soft", {10, 0}}}, {}, {}};
  for (size_t n = 0; n < model.bricks.count(); ++n) model.section_of.push_back(model.bricks.cells[n][0] < 2 ? 0 : 1);
  const Conditions conditions = held(
      model.bricks, [](Vec3) { return true; },
      [](Vec3 p) {
        return Vec3{0, 0, 0.01 * p.z};
      });
  const Stresses stresses = stresses_of(model, solve(model, conditions, {}));
  for (size_t n = 0; n < model.bricks.node_count(); ++n)
    EXPECT_NEAR(stresses.at_nodes_mpa[n][2], model.bricks.node(n).x <= 2 ? 10 : 0.1, 1e-9) << n;
}

// A tetrahedron has quadratic displacements: its linear stress is exact at its corners and in the middles of edges.
TEST(Stresses, TetrahedraCarryLinearStressesOn) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.nodes = {0, 1, 2, 3};
  MeshModel model{with_middle_nodes(mesh), {{"one", {1000, 0}}}, {0}, {}};
  model.mesh.kind = ElementKind::c3d10;
  Solution solution;
  for (const Vec3 p : model.mesh.points) solution.displacement_mm.push_back({0.005 * p.x * p.x, 0, 0});
  const Stresses stresses = stresses_of(model, solution);
  for (size_t n = 0; n < model.mesh.points.size(); ++n)
    EXPECT_NEAR(stresses.at_nodes_mpa[n][0], 10 * model.mesh.points[n].x, 1e-9) << n;
}

}  // namespace
}  // namespace ombre::fea
