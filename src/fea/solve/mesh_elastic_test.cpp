#include "fea/solve/mesh_elastic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/text/error.h"
#include "base/text/test_errors.h"
#include "fea/model/study.h"
#include "fea/model/test_element_meshes.h"

namespace ombre::fea {
namespace {

using namespace test;

constexpr std::array<ElementKind, 3> all_kinds{ElementKind::c3d4, ElementKind::c3d10, ElementKind::c3d8};
constexpr double any_value = std::numeric_limits<double>::quiet_NaN();

bool is_close(double a, double b) { return std::abs(a - b) < 1e-9; }

// The patch test: displacements that are linear on the border are linear within elements of any shape.
TEST(MeshElastic, LinearDisplacementsAreExact) {
  const auto on_border = [](Vec3 p) {
    return is_close(p.x, 0) || is_close(p.x, 4) || is_close(p.y, 0) || is_close(p.y, 1.5) || is_close(p.z, 0) ||
           is_close(p.z, 8);
  };
  for (const ElementKind kind : all_kinds) {
    const MeshModel model = mesh_model_of(block_of(kind, {4, 3, 4}, {1, 0.5, 2}, 0.15), rigid);
    const Solution solution = solve_mesh(model, held(model.mesh, on_border, linear_displacement), {});
    for (size_t n = 0; n < model.mesh.points.size(); ++n)
      EXPECT_LT(length(linear_displacement(model.mesh.points[n]) - solution.displacement_mm[n]), 1e-9);
    expect_linear_stresses(solution.stress_mpa);
  }
}

// The two solvers have the same element, so they give the same displacements, stresses, reactions and energy.
TEST(MeshElastic, BricksGiveWhatMultigridGives) {
  Model model = model_of(block({5, 4, 6}, {1, 0.8, 0.5}), rigid);
  model.sections.push_back({"soft", {3, 0.45, 0}});
  for (size_t n = 0; n < model.bricks.count(); n += 3) model.section_of[n] = 1;
  Conditions conditions = held(
      model.bricks, [](Vec3 p) { return p.z == 0; }, [](Vec3) { return Vec3{}; });
  for (uint32_t n = 0; n < model.bricks.node_count(); ++n)
    if (model.bricks.node(n).z == 3) conditions.forces.push_back({n, 0, 0.1});
  const Solution multigrid = solve(model, conditions, {1e-11, 20000, 0});
  const Solution assembled = solve_mesh(model, conditions, {1e-11, 20000, 0});
  for (size_t n = 0; n < model.bricks.node_count(); ++n)
    EXPECT_LT(length(multigrid.displacement_mm[n] - assembled.displacement_mm[n]), 1e-6);
  EXPECT_NEAR(multigrid.energy_mj, assembled.energy_mj, 1e-6 * assembled.energy_mj);
  for (size_t n = 0; n < model.bricks.count(); ++n)
    for (size_t k = 0; k < 6; ++k) EXPECT_NEAR(multigrid.stress_mpa[n][k], assembled.stress_mpa[n][k], 1e-4);
  for (size_t n = 0; n < conditions.displacements.size(); ++n)
    EXPECT_NEAR(multigrid.reactions_n[n].value, assembled.reactions_n[n].value, 1e-6);
}

// A bar hangs under its own weight: its end sinks by density g L^2 / (2 E), and its upper end carries the weight.
TEST(MeshElastic, BarsHangUnderTheirWeight) {
  for (const ElementKind kind : all_kinds) {
    const MeshModel model = mesh_model_of(block_of(kind, {2, 2, 20}, {1, 1, 1}), {100, 0, 2e-9});
    Study study;
    Support above;
    above.on.side = {2, true};
    above.displacement_mm = {0, 0, 0};
    study.supports.push_back(above);
    study.gravity_mm_s2 = {0, 0, -9810};
    Diagnostics diagnostics;
    const auto conditions = conditions_of(study, model, diagnostics);
    ASSERT_TRUE(conditions) << to_text(diagnostics);
    const Solution solution = solve_mesh(model, *conditions, {});
    double reaction = 0, lowest = 0;
    for (const Prescribed& r : solution.reactions_n)
      if (r.axis == 2) reaction += r.value;
    for (const Vec3& u : solution.displacement_mm) lowest = std::min(lowest, u.z);
    EXPECT_NEAR(reaction, 2e-9 * 9810 * 80, 1e-12);
    const double wanted = 2e-9 * 9810 * 400 / (2 * 100.0);
    EXPECT_NEAR(-lowest, wanted, (kind == ElementKind::c3d10 ? 1e-6 : 0.03) * wanted);
  }
}

// Returns F L^3 / (3 E I) + F L / (kappa G A) with kappa = 10 (1 + nu) / (12 + 11 nu) (Timoshenko; Cowper, 1966).
double tip_in_theory(double e, double nu) {
  const double l = 20, h = 4, kappa = 10 * (1 + nu) / (12 + 11 * nu), g = e / (2 * (1 + nu));
  return l * l * l / (3 * e * h * h * h * h / 12) + l / (kappa * g * h * h);
}

// Returns the deflection at the end of a cantilever of 20 x 4 x 4 mm under 1 N.
double tip_sinks(ElementKind kind, int32_t fine) {
  const double size = 4.0 / fine;
  const MeshModel model = mesh_model_of(block_of(kind, {5 * fine, fine, fine}, {size, size, size}), {1000, 0, 0});
  Study study;
  Load load;
  load.on.side = {0, true};
  load.force_n = {0, 0, -1};
  study.loads.push_back(load);
  Support wall, line_y, line_z;
  wall.on.side = {0, false};
  wall.displacement_mm[0] = 0;
  line_y.on.box = Box{{0, 2, 0}, {0, 2, 4}};
  line_y.displacement_mm[1] = 0;
  line_z.on.box = Box{{0, 0, 2}, {0, 4, 2}};
  line_z.displacement_mm[2] = 0;
  study.supports = {wall, line_y, line_z};
  Diagnostics diagnostics;
  const auto conditions = conditions_of(study, model, diagnostics);
  EXPECT_TRUE(conditions) << to_text(diagnostics);
  const Solution solution = solve_mesh(model, *conditions, {});
  double work = 0;
  for (const Prescribed& force : conditions->forces)
    work += force.value * solution.displacement_mm[force.node][force.axis];
  return work;  // work of a force of 1 N
}

// Plain tetrahedra are too stiff, hexahedra less so; the errors of both fall with the square of their size. Quadratic
// tetrahedra are close at once.
TEST(MeshElastic, CantileversBendAsTheorySays) {
  const double theory = tip_in_theory(1000, 0);
  const auto error = [&](ElementKind kind, int32_t fine) { return tip_sinks(kind, fine) / theory - 1; };
  for (const ElementKind kind : {ElementKind::c3d4, ElementKind::c3d8}) {
    const double coarse = error(kind, 2), fine = error(kind, 4);
    EXPECT_LT(coarse, 0);
    EXPECT_LT(std::abs(fine), 0.4 * std::abs(coarse));
  }
  EXPECT_LT(std::abs(error(ElementKind::c3d10, 2)), 0.01);
}

// Kirsch's plate under tension along x (Timoshenko and Goodier: Theory of Elasticity, 1951): a quarter of a ring of
// radii 1 and 4 in plane strain, whose outer border moves as in an infinite plate.
Vec3 kirsch(Vec3 p, double shear, double nu) {
  const double r = std::hypot(p.x, p.y), t = std::atan2(p.y, p.x), k = 3 - 4 * nu, r3 = r * r * r;
  const double x =
      r * (k + 1) * std::cos(t) + 2 / r * ((1 + k) * std::cos(t) + std::cos(3 * t)) - 2 / r3 * std::cos(3 * t);
  const double y =
      r * (k - 3) * std::sin(t) + 2 / r * ((1 - k) * std::sin(t) + std::sin(3 * t)) - 2 / r3 * std::sin(3 * t);
  return {x / (8 * shear), y / (8 * shear), 0};
}

// Returns the mean error of the nodes' displacements, relative to those of the border.
double plate_error(ElementKind kind, int32_t fine) {
  const double nu = 0.3, shear = 1000 / (2 * (1 + nu));
  Mesh mesh =
      block_of(kind == ElementKind::c3d8 ? kind : ElementKind::c3d4, {fine, fine, 1}, {1.0 / fine, 1.0 / fine, 0.5});
  for (Vec3& p : mesh.points) {
    const double r = std::pow(4.0, p.x), t = p.y * std::numbers::pi / 2;
    p = {r * std::cos(t), r * std::sin(t), p.z};
  }
  const MeshModel model =
      mesh_model_of(kind == ElementKind::c3d10 ? with_middle_nodes(mesh) : std::move(mesh), {1000, nu, 0});
  const auto value = [&](Vec3 p) {
    // Nodes in the middle of outer edges lie within the circle.
    const bool is_outer = std::hypot(p.x, p.y) > 4 * std::cos(std::numbers::pi / 4 / fine) - 1e-9;
    if (is_outer) return kirsch(p, shear, nu);
    return Vec3{std::abs(p.x) < 1e-9 ? 0 : any_value, std::abs(p.y) < 1e-9 ? 0 : any_value, 0};
  };
  const Solution solution = solve_mesh(model,
                                       held(
                                           model.mesh, [](Vec3) { return true; }, value),
                                       {});
  double sum = 0, scale = 0;
  for (size_t n = 0; n < model.mesh.points.size(); ++n) {
    const Vec3 wanted = kirsch(model.mesh.points[n], shear, nu), off = solution.displacement_mm[n] - wanted;
    sum += dot(off, off);
    scale += dot(wanted, wanted);
  }
  return std::sqrt(sum / scale);
}

// Displacements converge at least with the square of the size.
TEST(MeshElastic, KirschsPlateConverges) {
  for (const ElementKind kind : all_kinds) {
    const double coarse = plate_error(kind, 8), fine = plate_error(kind, 16);
    EXPECT_GT(std::log2(coarse / fine), 1.7) << shape_of(kind).name << " " << coarse << " " << fine;
    EXPECT_LT(fine, kind == ElementKind::c3d4 ? 0.01 : 0.003);
  }
}

// A nearly incompressible block lies under a plate that cannot slip: quadratic tetrahedra come near to bricks with the
// mean change of volume; plain ones lock.
TEST(MeshElastic, QuadraticTetrahedraHoldUpTo049) {
  const auto force = [](ElementKind kind) {
    const MeshModel model = mesh_model_of(block_of(kind, {4, 4, 4}, {1, 1, 1}), {1, 0.49, 0});
    const auto ends = [](Vec3 p) { return p.z == 0 || p.z == 4; };
    const auto press = [](Vec3 p) { return Vec3{0, 0, p.z > 1 ? -0.1 : 0}; };
    const Solution solution = solve_mesh(model, held(model.mesh, ends, press), {});
    double sum = 0;
    for (const Prescribed& r : solution.reactions_n)
      if (r.axis == 2 && r.value < 0) sum -= r.value;
    return sum;
  };
  const double bricks = force(ElementKind::c3d8);
  EXPECT_NEAR(force(ElementKind::c3d10), bricks, 0.1 * bricks);
  EXPECT_GT(force(ElementKind::c3d4), 1.2 * bricks);
}

TEST(MeshElastic, ManyUnknownsAreIterated) {
  const MeshModel model = mesh_model_of(block_of(ElementKind::c3d4, {16, 16, 16}, {1, 1, 1}), rigid);
  const auto ends = [](Vec3 p) { return p.x == 0 || p.x == 16; };
  const auto pull = [](Vec3 p) { return Vec3{p.x == 0 ? 0 : 0.16, 0, 0}; };
  const Conditions conditions = held(model.mesh, ends, pull);
  const Solution one = solve_mesh(model, conditions, {1e-8, 20000, 1});
  EXPECT_GT(one.iterations, 0U);
  EXPECT_EQ(one.displacement_mm, solve_mesh(model, conditions, {1e-8, 20000, 3}).displacement_mm);
  StopFlag stop;
  stop.request();
  EXPECT_THROW(solve_mesh(model, conditions, {}, nullptr, &stop), Cancelled);
  EXPECT_THROW(solve_mesh(model, conditions, {1e-14, 2, 0}), Error);
}

TEST(MeshElastic, InvertedElementsAreErrors) {
  MeshModel model = mesh_model_of(block_of(ElementKind::c3d4, {2, 2, 2}, {1, 1, 1}), rigid);
  std::swap(model.mesh.nodes[4], model.mesh.nodes[5]);
  const auto base = [](Vec3 p) { return p.z == 0; };
  const Conditions conditions = held(model.mesh, base, [](Vec3) { return Vec3{}; });
  expect_error([&] { solve_mesh(model, conditions, {}); }, "1 of the mesh's elements are inside out");
}

}  // namespace
}  // namespace ombre::fea
