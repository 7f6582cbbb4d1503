#include "import/surfaces/mesh_source.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <thread>

#include "base/system/test_source_files.h"
#include "formats/containers/file.h"
#include "formats/packages/read_mesh.h"
#include "import/fields/triangle_distance.h"
#include "import/surfaces/closest_point.h"
#include "import/surfaces/solid_angle.h"
#include "import/surfaces/test_meshes.h"

namespace ombre::importing {
namespace {

using namespace test;

double brute_distance(const Mesh& mesh, Vec3 p) {
  double best = Box::inf;
  for (const auto& t : mesh.triangles)
    best = std::min(best, squared_distance(p, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}));
  return std::sqrt(best);
}

Vec3 random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

TEST(MeshSource, KnowsItsChannelsAndBounds) {
  const auto source = make_mesh_source("cube.stl", cuboid({-1, -2, -3}, {1, 2, 3}), {});
  EXPECT_EQ(source->name(), "cube.stl");
  EXPECT_EQ(source->bounds(), Box::centered({1, 2, 3}));
  EXPECT_EQ(source->channel("inside"), 0);
  EXPECT_EQ(source->channel("distance"), has_mesh_distance() ? 1 : -1);
  EXPECT_EQ(source->channel("colour"), -1);
}

TEST(MeshSource, ContentDependsOnBytesAndRule) {
  const Mesh cube = cuboid({0, 0, 0}, {1, 1, 1});
  const Hash a = hash_bytes("a"), b = hash_bytes("b");
  EXPECT_EQ(make_mesh_source("m", cube, a)->content(), make_mesh_source("n", cube, a)->content());
  EXPECT_NE(make_mesh_source("m", cube, a)->content(), make_mesh_source("m", cube, b)->content());
  EXPECT_NE(make_mesh_source("m", cube, a)->content(), make_mesh_source("m", cube, a, {InsideRule::parity})->content());
}

TEST(MeshSource, InsideIsHalfOpen) {
  const auto source = make_mesh_source("m", cuboid({0, 0, 0}, {1, 1, 1}), {});
  EXPECT_EQ(source->sample(0, {0, 0, 0}), 1);
  EXPECT_EQ(source->sample(0, {0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(source->sample(0, {1, 0.5, 0.5}), 0);
  EXPECT_EQ(source->sample(0, {0.5, 1, 0.5}), 0);
  EXPECT_EQ(source->sample(0, {0.5, 0.5, 1}), 0);
  EXPECT_EQ(source->sample(0, {std::nan(""), 0.5, 0.5}), 0);
}

TEST(MeshSource, RangeOfInsideIsZeroAwayFromTheMesh) {
  const auto source = make_mesh_source("m", cuboid({0, 0, 0}, {1, 1, 1}), {});
  EXPECT_EQ(source->range(0, {{2, 0, 0}, {3, 1, 1}}), Interval(0));
  EXPECT_EQ(source->range(0, {{0.5, 0, 0}, {3, 1, 1}}), Interval(0, 1));
}

TEST(MeshSource, DistanceIsThatOfTheNearestTriangle) {
  if (!has_mesh_distance()) GTEST_SKIP() << "built without OMBRE_MESH_DISTANCE";
  std::mt19937 random(5);
  for (const Vec3 offset : {Vec3{0, 0, 0}, Vec3{1000, -2000, 500}}) {
    Mesh mesh = moved(torus(7, 2, 60, 30), Affine::translation(offset));
    mesh.triangles.push_back({3, 3, 3});
    mesh.triangles.push_back({5, 9, 5});
    const auto source = make_mesh_source("m", mesh, {});
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = offset + random_point(random, i % 2 == 0 ? 10 : 100);
      const double expected = brute_distance(mesh, p);
      const double found = source->sample(1, p);
      ASSERT_EQ(std::abs(found), expected);
      ASSERT_EQ(found < 0, source->sample(0, p) == 1);
    }
  }
}

// Returns paths near and far, with jumps, repetitions and points that are not finite.
std::vector<Vec3> random_paths(std::mt19937& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) {
    const bool jumps = i % 50 == 0;
    const Vec3 from = jumps ? random_point(random, i % 100 == 0 ? 1e6 : 12) : points.back();
    points.push_back(from + random_point(random, i % 7 == 0 ? 0 : 0.1));
  }
  points[300] = {std::nan(""), 0, 0};  // follows the path, which would stay NaN after it
  points[700] = {0, Box::inf, 0};
  return points;
}

// The sign may also change in the gap of an open mesh.
TEST(MeshSource, ManyPointsAtOnceGetTheSameBits) {
  std::mt19937 random(8);
  Mesh open = torus(7, 2, 60, 30);
  open.triangles.resize(open.triangles.size() - 400);
  for (const auto& source :
       {make_mesh_source("m", torus(7, 2, 60, 30), {}), make_mesh_source("m", open, {}, {InsideRule::generalized})}) {
    const std::vector<Vec3> points = random_paths(random);
    std::vector<double> values(points.size());
    for (int channel = 0; channel < (has_mesh_distance() ? 2 : 1); ++channel) {
      source->sample_all(channel, points, values);
      for (size_t n = 0; n < points.size(); ++n) ASSERT_EQ(values[n], source->sample(channel, points[n])) << n;
    }
  }
}

TEST(MeshSource, ChannelsTogetherGetTheSameBits) {
  if (!has_mesh_distance()) GTEST_SKIP() << "built without OMBRE_MESH_DISTANCE";
  std::mt19937 random(9);
  const auto source = make_mesh_source("m", torus(7, 2, 60, 30), {});
  const std::vector<Vec3> points = random_paths(random);
  const std::array channels{0, 1, 0};
  std::array<std::vector<double>, 3> values;
  std::array<double*, 3> rows{};
  for (size_t c = 0; c < channels.size(); ++c) {
    values[c].resize(points.size());
    rows[c] = values[c].data();
  }
  source->sample_channels(channels, points, rows);
  for (size_t c = 0; c < channels.size(); ++c)
    for (size_t n = 0; n < points.size(); ++n) ASSERT_EQ(values[c][n], source->sample(channels[c], points[n])) << n;
}

TEST(MeshSource, DistanceToASphereIsAnalyticWithinItsFacets) {
  if (!has_mesh_distance()) GTEST_SKIP() << "built without OMBRE_MESH_DISTANCE";
  const auto source = make_mesh_source("m", sphere(10, 5), {});
  std::mt19937 random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(random, 15);
    // The edges of facets, about 0.5 mm long, lie up to (edge / 2)^2 / 2 R inside of the sphere.
    ASSERT_NEAR(source->sample(1, p), length(p) - 10, 0.02);
  }
  EXPECT_NEAR(source->sample(1, {0, 0, 1e9}), 1e9 - 10, 1e-5);
  EXPECT_NEAR(source->sample(1, {0, 0, 1e30}), 1e30, 1e15);
  EXPECT_TRUE(std::isinf(source->sample(1, {std::nan(""), 0, 0})));
}

TEST(MeshSource, RangeOfDistanceHoldsItsSamples) {
  if (!has_mesh_distance()) GTEST_SKIP() << "built without OMBRE_MESH_DISTANCE";
  Mesh open = sphere(5, 2);
  open.triangles.resize(open.triangles.size() / 2);
  for (const Mesh& mesh : {sphere(5, 2), open}) {
    const auto source = make_mesh_source("m", mesh, {});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 500; ++i) {
      const Vec3 lo = random_point(random, 8);
      const Vec3 size = (unit(random) * 3) * Vec3{unit(random), unit(random), unit(random)};
      const Interval range = source->range(1, {lo, lo + size});
      for (int n = 0; n < 20; ++n) {
        const Vec3 p = lo + Vec3{unit(random) * size.x, unit(random) * size.y, unit(random) * size.z};
        ASSERT_TRUE(range.contains(source->sample(1, p)));
      }
    }
    EXPECT_TRUE(source->range(1, Box::everything()).is_everything());
  }
}

TEST(MeshSource, GeneralizedWindingClosesGaps) {
  Mesh open = cuboid({-1, -1, -1}, {1, 1, 1});
  open.triangles.resize(10);
  const auto source = make_mesh_source("m", open, {}, {InsideRule::generalized});
  for (double x = -2; x < 0.4; x += 0.07) {
    const Vec3 p{x, 0.13, -0.21};
    EXPECT_EQ(source->sample(0, p), x > -1 ? 1 : 0) << x;
  }
  EXPECT_EQ(source->sample(0, {1.5, 0, 0}), 0);
  EXPECT_EQ(source->sample(0, {0, 0, 1.01}), 0);
}

TEST(SolidAngle, DipolesAgreeWithTheExactSum) {
  const Mesh mesh = torus(7, 2, 60, 30);
  const SolidAngle fast(std::make_shared<Surface>(Surface{mesh.vertices, mesh.triangles}));
  const auto source = make_mesh_source("m", mesh, {});
  std::mt19937 random(8);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(random, 10);
    ASSERT_NEAR(fast.winding(p), source->sample(0, p), 0.1);
  }
}

TEST(MeshSource, ThreadsMayAskAtOnce) {
  const Mesh mesh = sphere(5, 4);
  const auto source = make_mesh_source("m", mesh, {});
  const auto rows = source->rows(0, Affine::translation({-6, -6, -6}));
  std::vector<std::thread> threads;
  std::array<size_t, 4> spans{};
  for (size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      std::vector<std::vector<program::Span>> found;
      for (int64_t k = 0; k < 12; ++k) {
        rows->layer(k, 0, 12, 12, found);
        for (const auto& row : found) spans[t] += row.size();
        EXPECT_EQ(source->sample(0, {0, 0, 0}), 1);
        if (has_mesh_distance()) {
          EXPECT_LT(source->sample(1, {0, 0, 0}), -4.9);
        }
      }
    });
  for (auto& thread : threads) thread.join();
  for (const size_t count : spans) EXPECT_EQ(count, spans[0]);
  EXPECT_GT(spans[0], 50u);
}

TEST(Inspect, MeasuresClosedMeshes) {
  const MeshReport cube = inspect(cuboid({1, 2, 3}, {3, 5, 7}));
  EXPECT_TRUE(cube.is_closed());
  EXPECT_NEAR(cube.volume, 24, 1e-12);
  EXPECT_NEAR(cube.area, 52, 1e-12);
  EXPECT_EQ(cube.bounds, (Box{{1, 2, 3}, {3, 5, 7}}));
  EXPECT_EQ(cube.degenerate, 0u);
  EXPECT_LT(inspect(turned_inward(cuboid({1, 2, 3}, {3, 5, 7}))).volume, 0);
  EXPECT_EQ(inspect(Mesh{}).triangles, 0u);
}

TEST(Inspect, FindsOpenAndInconsistentEdges) {
  Mesh open = cuboid({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  MeshReport report = inspect(open);
  EXPECT_EQ(report.open_edges, 3u);
  EXPECT_EQ(report.inconsistent_edges, 0u);
  EXPECT_EQ(report.examples.size(), 3u);

  Mesh flipped = cuboid({0, 0, 0}, {1, 1, 1});
  std::swap(flipped.triangles[4][0], flipped.triangles[4][1]);
  report = inspect(flipped);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.inconsistent_edges, 3u);
  EXPECT_FALSE(report.is_closed());
}

TEST(Inspect, MergesVerticesAtTheSamePlace) {
  Mesh soup;
  const Mesh cube = cuboid({-1, 0, 0}, {0, 1, 1});
  for (const auto& t : cube.triangles) {
    const auto first = static_cast<uint32_t>(soup.vertices.size());
    for (const uint32_t i : t) soup.vertices.push_back(cube.vertices[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.vertices[0].x = soup.vertices[0].x == 0 ? -0.0 : soup.vertices[0].x;
  soup.triangles.push_back({0, 1, 1});
  const MeshReport report = inspect(soup);
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.degenerate, 1u);
}

// The models in examples/models.
const std::filesystem::path models = source_file("examples/models");

// Open surfaces, on which examples lay cells.
const std::set<std::string> sheets{"head.off", "insole.off"};

TEST(Models, AreClosedAndFaceOutward) {
  size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(models)) {
    SCOPED_TRACE(entry.path().string());
    const std::string ending = entry.path().extension().string();
    if (ending != ".stl" && ending != ".off" && ending != ".obj" && ending != ".ply") continue;
    ++count;
    EXPECT_LT(entry.file_size(), 200'000u);
    Diagnostics diagnostics;
    const auto mesh = formats::read_mesh(entry.path().string(), diagnostics);
    ASSERT_TRUE(mesh) << to_text(diagnostics);
    EXPECT_TRUE(diagnostics.list().empty()) << to_text(diagnostics);
    const MeshReport report = inspect(*mesh);
    EXPECT_EQ(report.inconsistent_edges, 0u);
    EXPECT_EQ(report.degenerate, 0u);
    if (sheets.contains(entry.path().filename().string())) continue;
    EXPECT_TRUE(report.is_closed()) << report.open_edges << " open";
    EXPECT_GT(report.volume, 0);
  }
  EXPECT_GE(count, 6u);
}

TEST(Models, WingFitsItsBox) {
  Diagnostics diagnostics;
  const auto wing = formats::read_mesh((models / "wing.stl").string(), diagnostics);
  ASSERT_TRUE(wing);
  const MeshReport report = inspect(*wing);
  EXPECT_EQ(report.bounds, intersect(report.bounds, Box{{-23, -5, -1}, {23, 5, 3}}));
  EXPECT_EQ(report.bounds.axis(0), Interval(-23, 23));
  EXPECT_LT(report.triangles, 3000u);
}

TEST(Models, ComeFromTheirToolByteForByte) {
  if (std::system("python3 -c pass > /dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not installed";
  const auto made = std::filesystem::temp_directory_path() / ("ombre_models_" + std::to_string(::getpid()));
  const std::string tool = source_file("tools/make_models.py");
  ASSERT_EQ(std::system(("python3 '" + tool + "' '" + made.string() + "'").c_str()), 0);
  size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(made)) {
    ++count;
    EXPECT_EQ(formats::read_file(entry.path().string()),
              formats::read_file((models / entry.path().filename()).string()))
        << entry.path() << " differs; run tools/make_models.py";
  }
  EXPECT_GE(count, 6u);
  std::filesystem::remove_all(made);
}

}  // namespace
}  // namespace ombre::importing
