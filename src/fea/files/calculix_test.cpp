#include "fea/files/calculix.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/text/error.h"
#include "base/text/test_errors.h"
#include "fea/model/test_element_meshes.h"
#include "fea/solve/mesh_elastic.h"

namespace ombre::fea {
namespace {

using namespace test;

// The text is an excerpt of what CalculiX 2.20 prints.
TEST(Calculix, PrintedResultsHaveTheirPlaces) {
  const PrintedResults found = read_printed(R"(
 displacements (vx,vy,vz) for set NALL and time  0.1000000E+01

         1  0.000000E+00  1.500000E-01 -2.000000E+00
         2 -3.421053E-02  0.000000E+00  0.000000E+00

 stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set EALL and time  0.1000000E+01

         1   1  1.000000E+00  2.000000E+00  3.000000E+00  4.000000E+00  5.000000E+00  6.000000E+00
         1   2  3.000000E+00  2.000000E+00  3.000000E+00  4.000000E+00  5.000000E+00 -6.000000E+00

 heat flux (elem, integ.pnt.,qx,qy,qz) for setEALL and time  0.1000000E+01

         1   1  2.774287E-03 -2.661571E-03 -1.238734E+00
)",
                                            2, 1);
  ASSERT_EQ(found.displacements.size(), 2U);
  EXPECT_EQ(found.displacements[0], (std::array<double, 3>{0, 0.15, -2}));
  EXPECT_EQ(found.displacements[1][0], -3.421053e-2);
  ASSERT_EQ(found.stresses.size(), 1U);
  EXPECT_EQ(found.stresses[0], (std::array<double, 6>{2, 2, 3, 4, 5, 0}));
  EXPECT_EQ(found.fluxes[0][2], -1.238734);
  EXPECT_TRUE(found.temperatures.empty());
  EXPECT_THROW(read_printed(" forces (fx,fy,fz)\n   3 0. 0. 0.\n", 2, 1), Error);
  EXPECT_THROW(read_printed(" forces (fx,fy,fz)\n   1 0. 0.\n", 2, 1), Error);
  EXPECT_THROW(read_printed(" stresses (elem)\n   1 1 0. 0. 0. 0. 0. 0.\n", 2, 2), Error);
}

// Replaces the real program by a script that does what a test needs.
class FakeProgram : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("ccx" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    if (const char* path = std::getenv("PATH")) path_ = path;
  }
  void TearDown() override {
    setenv("PATH", path_.c_str(), 1);
    std::filesystem::remove_all(folder_);
  }

  void install(const std::string& script) {
    const auto program = folder_ / "ccx";
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
  }

  std::string path_;
  std::filesystem::path folder_;
};

Solution solve_small(const StopFlag* stop = nullptr) {
  const MeshModel model = mesh_model_of(block_of(ElementKind::c3d4, {1, 1, 1}, {1, 1, 1}), {1000, 0.3, 0});
  const auto ends = [](Vec3) { return true; };
  return solve_by_calculix(model, held(model.mesh, ends, [](Vec3 p) { return Vec3{0, 0, 1e-3 * p.z}; }), {}, stop);
}

TEST_F(FakeProgram, FailuresAreReported) {
  const auto solve = [] { solve_small(); };
  install("echo ' *ERROR in calinput: no such'; echo '        card'; exit 0");
  EXPECT_NE(failure_of(solve).find("did not finish; it said: *ERROR in calinput: no such card"), std::string::npos);
  install("kill -9 $$");
  EXPECT_NE(failure_of(solve).find("memory ran out"), std::string::npos);
  install("echo Job finished");
  EXPECT_NE(failure_of(solve).find("finished without displacements"), std::string::npos);
  setenv("PATH", "/nowhere", 1);
  EXPECT_NE(failure_of(solve).find("there is no program ccx"), std::string::npos);
}

TEST_F(FakeProgram, IsEndedWhenStopIsRequested) {
  const std::filesystem::path end = folder_ / "end";
  install("sleep 60; touch " + end.string());
  StopFlag stop;
  std::thread asks([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop.request();
  });
  EXPECT_THROW(solve_small(&stop), Cancelled);
  asks.join();
  EXPECT_FALSE(std::filesystem::exists(end));
}

// A block of two materials, held at one end and pushed aside at the other.
struct Pushed {
  MeshModel model;
  Conditions conditions;
};
Pushed pushed_block(ElementKind kind) {
  MeshModel model = mesh_model_of(block_of(kind, {4, 2, 2}, {1, 1, 1}, 0.15), {2850, 0.39, 0});
  model.sections.push_back({"soft", {100, 0.45, 0}});
  for (size_t n = 0; n < model.section_of.size(); ++n)
    if (MeshView(model.mesh).centroid(n).x > 2) model.section_of[n] = 1;
  Conditions conditions = held(
      model.mesh, [](Vec3 p) { return p.x == 0; }, [](Vec3) { return Vec3{}; });
  for (uint32_t n = 0; n < model.mesh.points.size(); ++n)
    if (model.mesh.points[n].x == 4) conditions.forces.push_back({n, 2, 0.5});
  return {std::move(model), std::move(conditions)};
}

bool has_program() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/ccx").c_str(), X_OK) == 0) return true;
  return false;
}

// The energies are those of CalculiX 2.20. If it is installed, all results are compared.
TEST(Calculix, GivesWhatTheBuiltInSolverGives) {
  constexpr std::array<std::pair<ElementKind, double>, 2> cases{
      {{ElementKind::c3d4, 0.233955525}, {ElementKind::c3d10, 2.945740925}}};
  for (const auto& [kind, energy] : cases) {
    const auto [model, conditions] = pushed_block(kind);
    const Solution own = solve_mesh(model, conditions, {1e-10, 20000, 0});
    EXPECT_NEAR(own.energy_mj, energy, 1e-6 * energy);
    if (!has_program()) continue;
    const Solution other = solve_by_calculix(model, conditions, {});
    EXPECT_NEAR(other.energy_mj, energy, 1e-6 * energy);
    double greatest = 0, strongest = 0;
    for (const Vec3& u : own.displacement_mm) greatest = std::max(greatest, length(u));
    for (const auto& stress : own.stress_mpa) strongest = std::max(strongest, von_mises(stress));
    for (size_t n = 0; n < own.displacement_mm.size(); ++n)
      EXPECT_LT(length(own.displacement_mm[n] - other.displacement_mm[n]), 1e-5 * greatest);
    for (size_t n = 0; n < own.stress_mpa.size(); ++n)
      for (size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(own.stress_mpa[n][k], other.stress_mpa[n][k], 1e-5 * strongest);
        EXPECT_NEAR(own.strain[n][k], other.strain[n][k], 1e-5 * strongest / 100);
      }
    for (size_t n = 0; n < own.reactions_n.size(); ++n)
      EXPECT_NEAR(own.reactions_n[n].value, other.reactions_n[n].value, 1e-3);
  }
}

}  // namespace
}  // namespace ombre::fea
