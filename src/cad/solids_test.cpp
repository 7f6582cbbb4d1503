#include "cad/solids.h"

#include <gtest/gtest.h>

#include <unistd.h>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <thread>

#include "base/system/test_source_files.h"
#include "base/text/error.h"
#include "base/text/test_errors.h"

namespace ombre::cad {
namespace {

using std::numbers::pi;

std::vector<SolidPtr> read(const std::string& name) { return read_solids(source_file("tests/cad/") + name); }

std::string message_for(const std::string& bytes, const std::string& ending) {
  const std::string path = testing::TempDir() + "cad" + std::to_string(getpid()) + ending;
  std::ofstream(path, std::ios::binary) << bytes;
  const std::string message = failure_of([&] { read_solids(path); });
  std::remove(path.c_str());
  return message;
}

std::string bytes_of(const std::string& name) {
  std::ifstream file(source_file("tests/cad/") + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

double volume(const Triangles& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
  return sum;
}

// Returns true if each edge is traversed once in each direction.
bool is_closed(const Triangles& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> passes;
  for (const auto& t : mesh.triangles)
    for (size_t n = 0; n < 3; ++n) {
      ++passes[{t[n], t[(n + 1) % 3]}];
      --passes[{t[(n + 1) % 3], t[n]}];
    }
  for (const auto& [edge, count] : passes)
    if (count != 0) return false;
  return true;
}

class Cad : public testing::Test {
 protected:
  void SetUp() override {
    const std::string message = failure_of([] { read("cylinder.step"); });
    if (message.find("without Open CASCADE") != std::string::npos) GTEST_SKIP() << message;
  }
};

}  // namespace

TEST_F(Cad, VolumesAndBoundsAreThoseOfTheShapes) {
  const auto cylinder = read("cylinder.step");
  ASSERT_EQ(cylinder.size(), 1u);
  EXPECT_EQ(cylinder[0]->name, "cylinder");
  EXPECT_NEAR(cylinder[0]->volume_mm3, 500 * pi, 1e-6);
  EXPECT_EQ(cylinder[0]->bounds, (Box{{-5, -5, 0}, {5, 5, 20}}));
  const auto sphere = read("sphere.step");
  EXPECT_NEAR(sphere[0]->volume_mm3, 4.0 / 3 * pi * 64, 1e-6);
  EXPECT_EQ(sphere[0]->bounds, (Box{{-3, -2, -1}, {5, 6, 7}}));
}

TEST_F(Cad, LengthsBecomeMillimetresAndFacesASolid) {
  EXPECT_EQ(read("block_in_inches.step")[0]->unit, "INCH");
  EXPECT_EQ(read("cylinder.step")[0]->unit, "millimetre");
  EXPECT_EQ(read("block.iges")[0]->unit, "MM");
  for (const char* name : {"block_in_inches.step", "block.iges"}) {
    const auto block = read(name);
    ASSERT_EQ(block.size(), 1u) << name;
    EXPECT_NEAR(block[0]->volume_mm3, 2000 - 90 * pi, 1e-3) << name;
    EXPECT_EQ(block[0]->bounds, (Box{{0, 0, 0}, {20, 10, 10}})) << name;
  }
}

TEST_F(Cad, SolidsHaveNamesAndColours) {
  for (const char* name : {"base_and_pin.step", "base_and_pin.iges"}) {
    const auto pair = read(name);
    ASSERT_EQ(pair.size(), 2u) << name;
    EXPECT_EQ(pair[0]->name, "base");
    EXPECT_EQ(pair[1]->name, "pin");
    EXPECT_EQ(pair[0]->colour, (std::array<uint8_t, 4>{255, 0, 0, 255}));
    EXPECT_EQ(pair[1]->colour, (std::array<uint8_t, 4>{0, 0, 255, 255}));
    EXPECT_NEAR(pair[1]->volume_mm3, 40 * pi, 1e-6);
  }
  EXPECT_FALSE(read("cylinder.step")[0]->colour);
}

TEST_F(Cad, InstancesAreInTheirPlaces) {
  const auto bolts = read("assembly.step");
  ASSERT_EQ(bolts.size(), 2u);
  for (const SolidPtr& bolt : bolts) {
    EXPECT_EQ(bolt->name, "bolt");
    EXPECT_NEAR(bolt->volume_mm3, 40 * pi, 1e-6);
    EXPECT_NEAR(volume(bolt->triangulate(0.001)), 40 * pi, 0.1);
  }
  EXPECT_EQ(bolts[0]->bounds, (Box{{-2, -2, 0}, {2, 2, 10}}));
  EXPECT_EQ(bolts[1]->bounds, (Box{{20, -2, -2}, {30, 2, 2}}));
  EXPECT_EQ(bolts[1]->colour, (std::array<uint8_t, 4>{0, 255, 0, 255}));
  EXPECT_NEAR(bolts[1]->query()->surface_distance({25, 0, 0}), 2, 1e-6);
}

TEST_F(Cad, TrianglesAreClosedAndNearTheSurface) {
  for (const char* name : {"cylinder.step", "sphere.step", "block.iges", "block_in_inches.step"})
    for (const double deflection : {0.2, 0.02}) {
      const SolidPtr solid = read(name)[0];
      const Triangles mesh = solid->triangulate(deflection);
      EXPECT_TRUE(is_closed(mesh)) << name;
      // The volume between two surfaces is at most their area times their distance; no area exceeds 1000 mm2.
      EXPECT_NEAR(volume(mesh), solid->volume_mm3, 1000 * deflection) << name;
    }
  for (const Vec3& p : read("cylinder.step")[0]->triangulate(0.1).vertices)
    EXPECT_TRUE(std::abs(std::hypot(p.x, p.y) - 5) < 1e-9 || std::abs(p.z) < 1e-9 || std::abs(p.z - 20) < 1e-9);
}

TEST_F(Cad, EqualQuestionsGetEqualTriangles) {
  const SolidPtr solid = read("sphere.step")[0];
  const Triangles fine = solid->triangulate(0.01), coarse = solid->triangulate(0.1);
  EXPECT_LT(coarse.triangles.size(), fine.triangles.size());
  EXPECT_EQ(read("sphere.step")[0]->triangulate(0.1).vertices, coarse.vertices);
}

TEST_F(Cad, QueriesAreExact) {
  const auto cylinder = read("cylinder.step")[0]->query(), sphere = read("sphere.step")[0]->query();
  EXPECT_NEAR(cylinder->surface_distance({8, 0, 24}), 5, 1e-6);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> length_mm(-12, 30);
  for (int n = 0; n < 100; ++n) {
    const Vec3 p{length_mm(random), length_mm(random), length_mm(random)};
    const double ring = std::hypot(p.x, p.y) - 5, cap = std::max(-p.z, p.z - 20);
    const double away =
        std::max(ring, cap) <= 0 ? std::max(ring, cap) : std::hypot(std::max(ring, 0.0), std::max(cap, 0.0));
    EXPECT_NEAR(cylinder->surface_distance(p), std::abs(away), 1e-6);
    EXPECT_EQ(cylinder->is_inside(p), away <= 0);
    const double round = length(p - Vec3{1, 2, 3}) - 4;
    EXPECT_NEAR(sphere->surface_distance(p), std::abs(round), 1e-6);
    EXPECT_EQ(sphere->is_inside(p), round <= 0);
  }
}

TEST_F(Cad, ThreadsAskAtOnce) {
  const SolidPtr solid = read("cylinder.step")[0];
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (size_t t = 0; t < wrong.size(); ++t)
    threads.emplace_back([&, t] {
      const auto query = solid->query();
      for (int n = 0; n < 50; ++n) {
        const double x = 0.2 * n + 0.05 * static_cast<double>(t) + 0.01;
        wrong[t] += std::abs(query->surface_distance({x, 0, 10}) - std::abs(x - 5)) > 1e-6;
        wrong[t] += query->is_inside({x, 0, 10}) != (x <= 5);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST_F(Cad, WhatIsNoSolidIsReported) {
  EXPECT_NE(failure_of([] { read("open_box.step"); }).find("5 surfaces and no solid"), std::string::npos);
  EXPECT_NE(message_for("", ".step").find("no valid file"), std::string::npos);
  EXPECT_NE(message_for("", ".igs"), "no error");
  EXPECT_NE(message_for("ISO-10303-21; nonsense", ".stp"), "no error");
  EXPECT_NE(message_for(bytes_of("cylinder.step").substr(0, 3000), ".step"), "no error");
  EXPECT_NE(message_for(bytes_of("block.iges").substr(0, 9000), ".iges"), "no error");
  // An entity of another type replaces each point: the library follows null pointers.
  std::string pointless = bytes_of("cylinder.step");
  for (size_t at = 0; (at = pointless.find("CARTESIAN_POINT", at)) != std::string::npos;) pointless.erase(at + 10, 1);
  EXPECT_NE(message_for(pointless, ".step"), "no error");
  // Valid files can be read afterwards.
  EXPECT_EQ(read("cylinder.step").size(), 1u);
}

// The library itself goes on reading a file that is cut off in the middle.
TEST(CadFiles, ShapesThatAreCutOffAreErrors) {
  const std::string whole = bytes_of("../cases/other_programs/fixtures/cadquery.brep");
  EXPECT_EQ(message_for(whole, ".brep"), "no error");
  EXPECT_EQ(message_for(whole + "\r\n\n", ".brep"), "no error");
  for (const size_t share : {0u, 1u, 3u, 5u, 7u, 9u}) {
    const std::string message = message_for(whole.substr(0, share * whole.size() / 10), ".brep");
    EXPECT_NE(message.find("it is cut off, or no file of its kind; write it again"), std::string::npos) << message;
  }
}

// The library searches a line without end for a point because a direction has infinite length.
TEST(CadFiles, AreStoppedWhileTheyAreRead) {
  std::string bytes = bytes_of("cylinder.step");
  const std::string direction = "#40 = DIRECTION('',(1.,0.));";
  ASSERT_NE(bytes.find(direction), std::string::npos);
  bytes.replace(bytes.find(direction), direction.size(), "#40 = DIRECTION('',(1E999,0.));");
  const std::string path = testing::TempDir() + "endless" + std::to_string(getpid()) + ".step";
  std::ofstream(path, std::ios::binary) << bytes;
  const StopFlag soon(nullptr, 0.5);
  EXPECT_THROW(read_solids(path, &soon), Cancelled);
  std::remove(path.c_str());
}

TEST(CadFiles, AreKnownByTheirEndings) {
  EXPECT_TRUE(is_cad_file("a/part.STEP"));
  EXPECT_TRUE(is_cad_file("part.igs"));
  EXPECT_FALSE(is_cad_file("part.stl"));
}

}  // namespace ombre::cad
