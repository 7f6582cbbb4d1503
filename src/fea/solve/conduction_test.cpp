#include "fea/solve/conduction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/text/json.h"
#include "fea/model/study.h"
#include "fea/model/test_element_meshes.h"
#include "fea/solve/direct.h"

namespace ombre::fea {
namespace {

using namespace test;

Conditions conditions_from(const std::string& text, const ModelView& model) {
  Diagnostics diagnostics;
  const auto data = parse_json(make_source("study.json", text), diagnostics);
  const auto study = data ? read_study(*data, diagnostics) : std::nullopt;
  const auto conditions = study ? conditions_of(*study, model, diagnostics) : std::nullopt;
  EXPECT_TRUE(conditions) << to_text(diagnostics);
  return conditions.value_or(Conditions{});
}

MeshModel conductor(ElementKind kind, Cell count, Vec3 size_mm, double conductivity, double shift = 0) {
  MeshModel model = mesh_model_of(block_of(kind, count, size_mm, shift), {});
  model.sections[0].conductivity = conductivity;
  return model;
}

// Temperatures that are linear on the border are linear inside, and the flux is -k times their gradient.
TEST(Conduction, LinearTemperaturesAreExact) {
  const auto linear = [](Vec3 p) { return 20 + 3 * p.x - 2 * p.y + p.z; };
  for (const ElementKind kind : {ElementKind::c3d4, ElementKind::c3d10, ElementKind::c3d8}) {
    const MeshModel model = conductor(kind, {3, 3, 3}, {1, 2, 0.5}, 200, 0.15);
    Conditions conditions;
    const Box inner = Box{{0, 0, 0}, {3, 6, 1.5}}.expanded(-1e-9);
    for (uint32_t n = 0; n < model.mesh.points.size(); ++n)
      if (!inner.contains(model.mesh.points[n]))
        conditions.displacements.push_back({n, 0, linear(model.mesh.points[n])});
    const Conduction found = conduct(model, conditions, {});
    for (size_t n = 0; n < model.mesh.points.size(); ++n)
      EXPECT_NEAR(found.value[n], linear(model.mesh.points[n]), 1e-9);
    for (const Vec3& flux : found.flux) EXPECT_LT(length(flux - Vec3{-0.6, 0.4, -0.2}), 1e-9);  // W/mm2
  }
}

// A wall of 10 mm and 4 mm2 with 0.5 W/(m K) at its left and 2 at its right.
TEST(Conduction, MaterialsInSeriesAndParallel) {
  for (const bool in_series : {true, false}) {
    Model model = model_of(block({4, 4, 10}, {0.5, 0.5, 1}), {});
    model.sections = {{"one", {}, 0.5}, {"two", {}, 2}};
    for (size_t n = 0; n < model.bricks.count(); ++n)
      model.section_of[n] = (in_series ? model.bricks.cells[n][2] >= 5 : model.bricks.cells[n][0] >= 2) ? 1 : 0;
    const Conduction found = conduct(model,
                                     conditions_from(R"({"physics": "heat", "supports": [
        {"on": "zmin", "temperature_c": 20}, {"on": "zmax", "temperature_c": 70}]})",
                                                     model),
                                     {1e-12});
    double enters = 0, leaves = 0;
    for (const Prescribed& flow : found.flows) (flow.value > 0 ? enters : leaves) += flow.value;
    const double conductance = in_series ? 4e-3 / (5 / 0.5 + 5 / 2.0) : 2e-3 * (0.5 + 2.0) / 10;  // W/K
    EXPECT_NEAR(enters, 50 * conductance, 1e-9);
    EXPECT_NEAR(leaves, -50 * conductance, 1e-9);
  }
}

// Bricks without a matrix give the same as a mesh of the same bricks with one, with films and two materials.
TEST(Conduction, BricksGiveWhatAMatrixGives) {
  Model model = model_of(block({7, 5, 9}, {1, 2, 0.5}), {});
  model.sections = {{"one", {}, 0.2}, {"two", {}, 400}};
  for (size_t n = 0; n < model.bricks.count(); ++n) model.section_of[n] = n % 3 == 0 ? 1 : 0;
  MeshModel meshed{{ElementKind::c3d8, {}, {}}, model.sections, model.section_of, {}};
  for (size_t n = 0; n < model.bricks.node_count(); ++n) meshed.mesh.points.push_back(model.bricks.node(n));
  for (const auto& nodes : model.bricks.nodes)
    meshed.mesh.nodes.insert(meshed.mesh.nodes.end(), nodes.begin(), nodes.end());
  const std::string study = R"({"physics": "heat", "supports": [{"on": "zmin", "temperature_c": 20}], "loads": [
      {"on": "xmax", "heat_w": 1.5}, {"on": {"facing": [0, 1, 0]}, "film_w_m2k": 500, "ambient_c": -5}]})";
  const Conduction free = conduct(model, conditions_from(study, model), {1e-12});
  const Conduction matrix = conduct(meshed, conditions_from(study, meshed), {1e-12});
  ASSERT_EQ(free.value.size(), matrix.value.size());
  for (size_t n = 0; n < free.value.size(); ++n) EXPECT_NEAR(free.value[n], matrix.value[n], 1e-4);
  EXPECT_NEAR(free.lost_w, matrix.lost_w, 1e-6);
  EXPECT_GT(free.lost_w, 0.1);
  if (!has_factorisations()) return;
  SolveOptions by_factor{1e-12};
  by_factor.solver = "direct";
  const Conduction factorised = conduct(model, conditions_from(study, model), by_factor);
  EXPECT_LE(factorised.iterations, 4U);
  for (size_t n = 0; n < free.value.size(); ++n) EXPECT_NEAR(free.value[n], factorised.value[n], 1e-7);
}

TEST(Conduction, MultigridKeepsIterationsFew) {
  for (const int32_t count : {10, 20, 40}) {
    Model model = model_of(block({count, count, count}, {1, 1, 1}), {});
    model.sections = {{"one", {}, 1}};
    const Conduction found = conduct(model,
                                     conditions_from(R"({"physics": "heat", "supports": [
        {"on": "zmin", "temperature_c": 20}], "loads": [{"on": "xmax", "heat_w": 1}]})",
                                                     model),
                                     {});
    EXPECT_LE(found.iterations, 14U) << count;
  }
}

// In a wall whose conductivity is exp(z / 10), the flux is the difference of temperatures over the integral of 1 / k.
TEST(Conduction, GradedWallsFollowTheirIntegral) {
  std::vector<double> errors;
  for (const int32_t fine : {10, 20}) {
    Model model = model_of(block({1, 1, fine}, {2, 2, 10.0 / fine}), {});
    model.sections.clear();
    for (int32_t n = 0; n < fine; ++n) {
      model.sections.push_back({"layer", {}, std::exp((n + 0.5) / fine)});
      model.section_of[static_cast<size_t>(n)] = static_cast<uint16_t>(n);
    }
    const Conduction found = conduct(model,
                                     conditions_from(R"({"physics": "heat", "supports": [
        {"on": "zmin", "temperature_c": 0}, {"on": "zmax", "temperature_c": 100}]})",
                                                     model),
                                     {});
    const double flux = 100 * 1e-3 / (10 * (1 - std::exp(-1)));  // W/mm2
    errors.push_back(std::abs(-found.flux[0].z - flux) / flux);
  }
  EXPECT_LT(errors[1], 2e-4);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.1);
}

// Heat enters below with 0.01 W/mm2 and leaves above to air: the surface is warmer than the air by flux / film, the
// other side by flux L / k more.
TEST(Conduction, WallsCoolInAir) {
  for (const ElementKind kind : {ElementKind::c3d4, ElementKind::c3d10, ElementKind::c3d8}) {
    const MeshModel model = conductor(kind, {2, 2, 4}, {1, 1, 2.5}, 0.2);
    const Conduction found = conduct(model,
                                     conditions_from(R"({"physics": "heat", "loads": [
        {"on": "zmin", "flux_w_mm2": 0.0001}, {"on": "zmax", "film_w_m2k": 25, "ambient_c": 20}]})",
                                                     model),
                                     {});
    for (size_t n = 0; n < model.mesh.points.size(); ++n)
      EXPECT_NEAR(found.value[n], 20 + 100 / 25.0 + 0.1 * (10 - model.mesh.points[n].z) / 0.2, 1e-6);
    EXPECT_NEAR(found.lost_w, 4e-4, 1e-10);
  }
}

// A current of 1 A through a bar of 1 mm2 and 8 mm with 100 S/m needs 80 V.
TEST(Conduction, CurrentsFollowOhmsLaw) {
  const MeshModel model = conductor(ElementKind::c3d10, {1, 1, 8}, {1, 1, 1}, 100);
  const Conduction found = conduct(model,
                                   conditions_from(R"({"physics": "electric", "supports": [
      {"on": "zmin", "potential_v": 0}], "loads": [{"on": "zmax", "current_a": 1}]})",
                                                   model),
                                   {});
  EXPECT_NEAR(*std::ranges::max_element(found.value), 80, 1e-8);
  double leaves = 0;
  for (const Prescribed& flow : found.flows) leaves += flow.value;
  EXPECT_NEAR(leaves, -1, 1e-9);
}

}  // namespace
}  // namespace ombre::fea
