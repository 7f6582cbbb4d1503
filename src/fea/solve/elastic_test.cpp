#include "fea/solve/elastic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/test_errors.h"
#include "fea/model/study.h"
#include "fea/model/test_models.h"
#include "fea/solve/brick_stiffness.h"
#include "fea/solve/direct.h"

namespace ombre::fea {
namespace {

using namespace test;

constexpr double free_axis = std::numeric_limits<double>::quiet_NaN();

bool is_near(double a, double b) { return std::abs(a - b) < 1e-9; }

// The patch test: displacements that are linear on the border are linear inside, whatever the shape of the bricks.
TEST(Elastic, LinearDisplacementsAreExact) {
  const Model model = model_of(block({4, 3, 5}, {1, 0.5, 2}, {-3, 1, 7}), rigid);
  const auto on_border = [](Vec3 p) {
    return is_near(p.x, -3) || is_near(p.x, 1) || is_near(p.y, 1) || is_near(p.y, 2.5) || is_near(p.z, 7) ||
           is_near(p.z, 17);
  };
  const Solution solution = solve(model, held(model.bricks, on_border, linear_displacement), {});
  for (size_t n = 0; n < model.bricks.node_count(); ++n) {
    const Vec3 wanted = linear_displacement(model.bricks.node(n)), got = solution.displacement_mm[n];
    EXPECT_LT(length(got - wanted), 1e-8);
  }
  expect_linear_stresses(solution.stress_mpa);
}

// A bar under tension stretches by F / (E A) of its length, narrows by nu of that, and its energy is half the work.
TEST(Elastic, BarsStretchByHookesLaw) {
  const Model model = model_of(block({2, 2, 10}, {1, 1, 1}), rigid);
  Conditions conditions;
  for (uint32_t n = 0; n < model.bricks.node_count(); ++n) {
    const Vec3 p = model.bricks.node(n);
    if (p.x == 0) conditions.displacements.push_back({n, 0, 0});
    if (p.y == 0) conditions.displacements.push_back({n, 1, 0});
    if (p.z == 0) conditions.displacements.push_back({n, 2, 0});
    const double share = (p.x == 1 ? 2 : 1) * (p.y == 1 ? 2 : 1) / 16.0;
    if (p.z == 10) conditions.forces.push_back({n, 2, 400 * share});  // 100 MPa
  }
  const Solution solution = solve(model, conditions, {});
  const double strain = 100 / 2850.0;
  for (size_t n = 0; n < model.bricks.node_count(); ++n) {
    const Vec3 p = model.bricks.node(n), u = solution.displacement_mm[n];
    EXPECT_NEAR(u.z, strain * p.z, 1e-7);
    EXPECT_NEAR(u.x, -0.39 * strain * p.x, 1e-7);
  }
  for (const auto& stress : solution.stress_mpa) EXPECT_NEAR(von_mises(stress), 100, 1e-4);
  EXPECT_NEAR(solution.energy_mj, 0.5 * 400 * strain * 10, 1e-5);
  double reaction = 0;
  for (const Prescribed& r : solution.reactions_n)
    if (r.axis == 2) reaction += r.value;
  EXPECT_NEAR(reaction, -400, 1e-5);
}

// Two materials without lateral contraction lie one above the other, so their compliances add up, or side by side, so
// their stiffnesses do.
TEST(Elastic, MaterialsInSeriesAndParallel) {
  for (const bool in_series : {true, false}) {
    Model model = model_of(block({4, 4, 4}, {0.5, 0.5, 0.5}), {1000, 0, 0});
    model.sections.push_back({"two", {10, 0, 0}});
    for (size_t n = 0; n < model.bricks.count(); ++n)
      model.section_of[n] = model.bricks.cells[n][in_series ? 2 : 0] >= 2 ? 1 : 0;
    const auto ends = [](Vec3 p) { return is_near(p.z, 0) || is_near(p.z, 2); };
    const auto pull = [](Vec3 p) { return Vec3{0, 0, p.z > 1 ? 0.02 : 0}; };
    const Solution solution = solve(model, held(model.bricks, ends, pull), {});
    double force = 0;
    for (const Prescribed& r : solution.reactions_n)
      if (r.axis == 2 && model.bricks.node(r.node).z > 1) force += r.value;
    const double modulus = in_series ? 2 / (1 / 1000.0 + 1 / 10.0) : (1000 + 10) / 2.0;
    EXPECT_NEAR(force, modulus * 0.01 * 4, 1e-6 * force);
  }
}

// Returns the deflection at the end of a cantilever of 40 x 4 x 4 mm under 1 N, with `fine` bricks along its height.
double end_sinks(double e, double nu, int32_t fine) {
  const double l = 40, h = 4, size = h / fine;
  const Model model = model_of(block({10 * fine, fine, fine}, {size, size, size}), {e, nu, 0});
  Conditions conditions = held(
      model.bricks, [](Vec3 p) { return p.x == 0; },
      [&](Vec3 p) {
        return Vec3{0, is_near(p.y, h / 2) ? 0 : free_axis, is_near(p.z, h / 2) ? 0 : free_axis};
      });
  const auto share = [&](Vec3 p) {  // share of the end's area
    const auto along = [&](double at) { return (is_near(at, 0) || is_near(at, h) ? 0.5 : 1.0) / fine; };
    return is_near(p.x, l) ? along(p.y) * along(p.z) : 0;
  };
  for (uint32_t n = 0; n < model.bricks.node_count(); ++n)
    if (const double part = share(model.bricks.node(n)); part > 0) conditions.forces.push_back({n, 2, -part});
  const Solution solution = solve(model, conditions, {});
  double sinks = 0;
  for (uint32_t n = 0; n < model.bricks.node_count(); ++n)
    sinks -= share(model.bricks.node(n)) * solution.displacement_mm[n].z;
  return sinks;
}

// Returns F L^3 / (3 E I) + F L / (kappa G A) with kappa = 10 (1 + nu) / (12 + 11 nu) (Timoshenko; Cowper, 1966).
double end_sinks_in_theory(double e, double nu) {
  const double l = 40, h = 4, kappa = 10 * (1 + nu) / (12 + 11 * nu), g = e / (2 * (1 + nu));
  return l * l * l / (3 * e * h * h * h * h / 12) + l / (kappa * g * h * h);
}

// The error of trilinear bricks falls with the square of their size.
TEST(Elastic, CantileversBendAsTheorySays) {
  std::vector<double> errors;
  for (const int32_t fine : {4, 8, 16}) errors.push_back(end_sinks_in_theory(1000, 0) / end_sinks(1000, 0, fine) - 1);
  EXPECT_LT(std::abs(errors[2]), 0.01);
  const double order = std::log2((errors[0] - errors[1]) / (errors[1] - errors[2]));
  EXPECT_NEAR(order, 2, 0.2);
  EXPECT_NEAR(end_sinks(1000, 0.3, 8), end_sinks_in_theory(1000, 0.3), 0.01 * end_sinks_in_theory(1000, 0.3));
}

// A nearly incompressible block under a plate that cannot slip does not lock: with nu from 0.49 to 0.4999 it grows
// stiffer by less than a tenth (bricks of plain full integration grow by much more than twice).
TEST(Elastic, NearlyIncompressibleBlocksDoNotLock) {
  std::vector<double> forces;
  for (const double nu : {0.49, 0.4999}) {
    const Model model = model_of(block({6, 6, 6}, {1, 1, 1}), {1, nu, 0});
    const auto ends = [](Vec3 p) { return p.z == 0 || p.z == 6; };
    const Solution solution = solve(model,
                                    held(model.bricks, ends,
                                         [](Vec3 p) {
                                           return Vec3{0, 0, p.z > 1 ? -0.1 : 0};
                                         }),
                                    {});
    double force = 0;
    for (const Prescribed& r : solution.reactions_n)
      if (r.axis == 2 && r.value < 0) force -= r.value;
    forces.push_back(force);
  }
  EXPECT_GT(forces[1], forces[0]);
  EXPECT_LT(forces[1], 1.1 * forces[0]);
}

// Random draws of two materials whose moduli differ 10,000 times, as in dithered prints.
Model dithered(int32_t count) {
  Model model = model_of(block({count, count, count}, {0.3, 0.3, 0.3}), rigid);
  model.sections.push_back({"soft", {0.285, 0.45, 0}});
  std::mt19937 random(3);
  for (uint16_t& section : model.section_of) section = static_cast<uint16_t>(random() % 2);
  return model;
}

Conditions compressed(const Bricks& bricks) {
  double top = 0;
  for (size_t n = 0; n < bricks.node_count(); ++n) top = std::max(top, bricks.node(n).z);
  return held(
      bricks, [=](Vec3 p) { return p.z == 0 || p.z == top; },
      [](Vec3 p) {
        return Vec3{0, 0, p.z > 0 ? -0.1 : 0};
      });
}

TEST(Elastic, TheSameBitsWithAnyThreads) {
  const Model model = dithered(16);
  const Conditions conditions = compressed(model.bricks);
  const Solution one = solve(model, conditions, {1e-6, 20000, 1});
  const Solution four = solve(model, conditions, {1e-6, 20000, 4});
  EXPECT_EQ(one.displacement_mm, four.displacement_mm);
  EXPECT_EQ(one.iterations, four.iterations);
}

// The sums and differences of a brick's corners and its matrix give the same forces.
TEST(Elastic, PatternsGiveWhatTheMatrixGives) {
  const BrickStiffness brick = brick_stiffness({1, 2, 0.5});
  BrickVector u, found{};
  for (size_t n = 0; n < u.size(); ++n) u[n] = std::sin(static_cast<double>(n * n + 1));
  constexpr double shear = 3, bulk = 40;
  brick.add_forces(shear, bulk, u, found);
  double divergence = 0;
  for (size_t n = 0; n < u.size(); ++n) divergence += brick.dilation[n] * u[n];
  for (size_t n = 0; n < u.size(); ++n) {
    double wanted = bulk * brick.volume_mm3 * divergence * brick.dilation[n];
    for (size_t m = 0; m < u.size(); ++m) wanted += shear * brick.shear[n][m] * u[m];
    EXPECT_NEAR(found[n], wanted, 1e-12) << n;
  }
}

// Iterations hardly grow with the number of bricks.
TEST(Elastic, MultigridKeepsIterationsFew) {
  std::vector<size_t> iterations;
  for (const int32_t count : {8, 16, 32}) {
    const Model model = model_of(block({count, count, count}, {0.3, 0.3, 0.3}), rigid);
    iterations.push_back(solve(model, compressed(model.bricks), {1e-8, 20000, 0}).iterations);
  }
  EXPECT_LT(iterations[2], 20U);
  EXPECT_LT(iterations[2], iterations[0] + 10);
}

// Thin struts of materials that differ 7,400 times, which coarse grids do not resolve.
Model graded_lattice() {
  constexpr int32_t size = 16, cell = 8;
  std::vector<Cell> cells;
  const auto is_strut = [](const Cell& at) {
    const auto along = [&](size_t axis) { return std::abs(2 * (at[axis] % cell) - cell + 1); };
    return along(0) == along(1) && along(1) == along(2);
  };
  for (int32_t k = 0; k < size; ++k)
    for (int32_t j = 0; j < size; ++j)
      for (int32_t i = 0; i < size; ++i)
        if (is_strut({i, j, k}) || is_strut({i + 1, j, k}) || is_strut({i, j + 1, k}) || is_strut({i, j, k + 1}))
          cells.push_back({i, j, k});
  Model model{
      make_bricks({}, {0.5, 0.5, 0.5}, std::move(cells)), {{"rigid", {2850, 0.39}}, {"soft", {0.383, 0.49}}}, {}, {}};
  for (size_t n = 0; n < model.bricks.count(); ++n) model.section_of.push_back((n * 7919) % 5 < 2 ? 0 : 1);
  return model;
}

// Returns the sum of the reactions at the bottom.
double force_of(const Solution& solution, const Bricks& bricks) {
  double force = 0;
  for (const Prescribed& here : solution.reactions_n)
    if (here.axis == 2 && bricks.corners[here.node][2] == 0) force += here.value;
  return force;
}

// Returns the conditions of a strip that is held at one end and pressed down at the other by 1 N.
Conditions pressed_at_its_end(const Model& model) {
  Diagnostics diagnostics;
  const auto data = parse_json(make_source("strip.json", R"({
      "supports": [{"on": "xmin", "fix": "xyz"}], "loads": [{"on": "xmax", "force_n": [0, 0, -1]}]})"),
                               diagnostics);
  return *conditions_of(*read_study(*data, diagnostics), model, diagnostics);
}

// Returns the deflection of a strip's end under a force of 1 N, by the work of the force.
double deflection(const Model& model) {
  const Conditions conditions = pressed_at_its_end(model);
  const Solution solution = solve(model, conditions, {1e-10, 20000, 2});
  double work = 0;
  for (const Prescribed& force : conditions.forces)
    work += force.value * solution.displacement_mm[force.node][force.axis];
  return work;
}

// Timoshenko's beam of 20 x 4 x 1 mm and 1000 MPa, without Poisson's effect, bends by F L^3 / (3 E I) = 8 mm, and by
// 0.012 from shear, F L / (5/6 G A). Bricks as thick as the strip, or twice as thick, bend as it does, since they have
// linear strains.
TEST(Elastic, StripsBendByTheirThicknessWhateverTheBricks) {
  for (const double brick_mm : {2.0, 1.0, 0.8, 0.5}) {
    const Model model = model_of(test::cut_block({20, 4, 1}, brick_mm), {1000, 0});
    EXPECT_NEAR(model.bricks.filled_count() * model.bricks.volume_mm3(), 80, 1e-9) << brick_mm;
    EXPECT_NEAR(deflection(model), 8.012, 0.03) << brick_mm;
  }
}

// A strip of full bricks, one across, is as thick as they are, and too stiff.
TEST(Elastic, FullBricksAreAsThickAsTheyAre) {
  const double wanted = 4.0 * 20 * 20 * 20 / (1000 * 4.0 * 8);
  EXPECT_NEAR(deflection(model_of(block({10, 2, 1}, {2, 2, 2}), {1000, 0})), wanted, 0.15 * wanted);
}

// A uniform strain gives a uniform stress, however bricks are cut.
TEST(Elastic, CutBricksPassThePatchTest) {
  Bricks bricks = block({3, 3, 3}, {1, 1.5, 0.75});
  for (size_t n = 0; n < bricks.count(); ++n) bricks.fills.push_back(n % 2 == 0 ? full_fill : full_fill << (n + 1));
  const Model model = model_of(std::move(bricks), {1000, 0.3});
  const auto even = [](Vec3 p) {
    return Vec3{0.01 * p.x + 0.003 * p.y, -0.004 * p.y + 0.002 * p.z, 0.005 * p.z + 0.001 * p.x};
  };
  const Conditions conditions = held(
      model.bricks, [](Vec3) { return true; }, even);
  const Solution solution = solve(model, conditions, {1e-10, 20000, 2});
  const double shear = 1000 / 2.6, bulk = 1000 / 1.2, dilation = 0.011;
  double volume = 0;
  for (size_t n = 0; n < model.bricks.count(); ++n) volume += model.bricks.share(n) * model.bricks.volume_mm3();
  double deviators = -dilation * dilation / 3 * 2;
  for (const double strain : {0.01, -0.004, 0.005}) deviators += 2 * strain * strain;
  for (const double strain : {0.003, 0.002, 0.001}) deviators += strain * strain;
  EXPECT_NEAR(solution.energy_mj, 0.5 * volume * (shear * deviators + bulk * dilation * dilation), 1e-9);
}

TEST(Elastic, AFactorisationGivesWhatMultigridGives) {
  if (!has_factorisations()) GTEST_SKIP() << "built without MUMPS";
  const Model model = graded_lattice();
  SolveOptions options{1e-10, 20000, 2};
  const Solution slow = solve(model, compressed(model.bricks), options);
  options.solver = "direct";
  std::vector<double> disk;
  options.announce = [&](const DirectUse& use) { disk.push_back(use.disk_bytes); };
  const Solution quick = solve(model, compressed(model.bricks), options);
  EXPECT_LE(quick.iterations, 8U);
  EXPECT_GT(slow.iterations, 5 * quick.iterations);
  EXPECT_NEAR(force_of(quick, model.bricks), force_of(slow, model.bricks),
              1e-6 * std::abs(force_of(slow, model.bricks)));
  EXPECT_NEAR(quick.energy_mj, slow.energy_mj, 1e-7 * slow.energy_mj);
  ASSERT_TRUE(quick.direct);
  options.threads = 1;
  EXPECT_EQ(solve(model, compressed(model.bricks), options).displacement_mm, quick.displacement_mm);
  // The memory is less than the factor takes, so it goes to the disk.
  options.memory_bytes = quick.direct->memory_bytes - 1;
  const Solution beside = solve(model, compressed(model.bricks), options);
  EXPECT_NEAR(beside.energy_mj, quick.energy_mj, 1e-7 * quick.energy_mj);
  ASSERT_EQ(disk.size(), 3U);
  EXPECT_EQ(disk[0], 0);
  EXPECT_GT(disk[2], 0);
  options.memory_bytes = 1e5;
  EXPECT_THROW(solve(model, compressed(model.bricks), options), Error);
}

TEST(Elastic, WhatIsSlowIsFactorised) {
  if (!has_factorisations()) GTEST_SKIP() << "built without MUMPS";
  const Model model = graded_lattice();
  SolveOptions options{1e-10, 20000, 0, "auto"};
  const Solution found = solve(model, compressed(model.bricks), options);
  EXPECT_TRUE(found.direct) << found.iterations;
  options.memory_bytes = 1e5;
  EXPECT_FALSE(solve(model, compressed(model.bricks), options).direct);
  const Model even = model_of(block({12, 12, 12}, {0.3, 0.3, 0.3}), rigid);
  EXPECT_FALSE(solve(even, compressed(even.bricks), {1e-8, 20000, 0, "auto"}).direct);
}

// A plate of 60 x 20 x 1 mm is too near to singular for single precision: a factorisation in double precision follows.
TEST(Elastic, ThinPlatesAreFactorisedInDoublePrecision) {
  if (!has_factorisations()) GTEST_SKIP() << "built without MUMPS";
  const Model model = model_of(block({60, 20, 2}, {1, 1, 0.5}), {1000, 0.3});
  const Conditions conditions = pressed_at_its_end(model);
  const Solution slow = solve(model, conditions, {1e-9, 20000, 2});
  for (const char* solver : {"direct", "auto"}) {
    const Solution found = solve(model, conditions, {1e-9, 20000, 2, solver});
    EXPECT_NEAR(found.energy_mj, slow.energy_mj, 1e-5 * slow.energy_mj);
  }
  // If there is no room for the factor, multigrid goes on.
  EXPECT_NEAR(solve(model, conditions, {1e-9, 20000, 2, "auto", 1e5}).energy_mj, slow.energy_mj, 1e-5 * slow.energy_mj);
}

TEST(Elastic, AFactorisationStops) {
  if (!has_factorisations()) GTEST_SKIP() << "built without MUMPS";
  const Model model = graded_lattice();
  StopFlag stop;
  SolveOptions options{1e-10, 20000, 0, "direct"};
  options.announce = [&](const DirectUse&) { stop.request(); };
  EXPECT_THROW(solve(model, compressed(model.bricks), options, nullptr, &stop), Cancelled);
}

TEST(Elastic, AFactorisationSaysWhatItDoes) {
  if (!has_factorisations()) GTEST_SKIP() << "built without MUMPS";
  struct Listener : Progress {
    std::set<std::string> steps;
    void update(const HowFar&) override {}
    void preparing(const std::string& what, const HowFar& how_far) override {
      steps.insert(what);
      EXPECT_LT(how_far.done, how_far.total);
    }
  } listener;
  const Model model = graded_lattice();
  solve(model, compressed(model.bricks), {1e-10, 20000, 0, "direct"}, &listener);
  EXPECT_EQ(listener.steps, (std::set<std::string>{"factorising the equations", "ordering the equations"}));
}

TEST(Elastic, StopsAndFailsInWords) {
  const Model model = dithered(16);
  StopFlag stop;
  stop.request();
  EXPECT_THROW(solve(model, compressed(model.bricks), {}, nullptr, &stop), Cancelled);
  expect_error([&] { solve(model, compressed(model.bricks), {1e-12, 2, 0}); }, "did not converge");
}

}  // namespace
}  // namespace ombre::fea
