#include "import/surfaces/cad_source.h"

#include <gtest/gtest.h>

#include <random>

#include "base/system/test_source_files.h"
#include "base/text/error.h"

namespace ombre::importing {
namespace {

class CadSources : public testing::Test {
 protected:
  void SetUp() override {
    try {
      ball_ = cad::read_solids(source_file("tests/cad/sphere.step"));
    } catch (const Error& error) {
      if (std::string(error.what()).find("without Open CASCADE") == std::string::npos) throw;
      GTEST_SKIP() << error.what();
    }
  }

  Vec3 point(double half) { return {1 + number(-half, half), 2 + number(-half, half), 3 + number(-half, half)}; }
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  // Returns the distance to the file's ball.
  static double exact(Vec3 p) { return length(p - Vec3{1, 2, 3}) - 4; }

  std::vector<cad::SolidPtr> ball_;
  std::mt19937 random_{1};
};

}  // namespace

TEST_F(CadSources, ExactOnesHaveTheDistanceOfTheSurface) {
  const auto source = make_exact_source("ball", ball_, {}, 0.05).source;
  const int inside = source->channel("inside"), distance = source->channel("distance");
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = point(6);
    EXPECT_NEAR(source->sample(distance, p), exact(p), 1e-6);
    EXPECT_EQ(source->sample(inside, p), exact(p) <= 0 ? 1 : 0);
  }
}

TEST_F(CadSources, TrianglesAreAsNearAsTheirDeflection) {
  for (const double deflection : {0.1, 0.01}) {
    const auto source = make_triangle_source("ball", ball_, {}, deflection).source;
    double farthest = 0;
    for (int n = 0; n < 500; ++n) {
      const Vec3 p = point(6);
      farthest = std::max(farthest, std::abs(source->sample(source->channel("distance"), p) - exact(p)));
    }
    EXPECT_LE(farthest, 1.5 * deflection);
    EXPECT_GT(farthest, 0.1 * deflection);
  }
}

TEST_F(CadSources, RangesHoldPoints) {
  const auto source = make_exact_source("ball", ball_, {}, 0.05).source;
  for (int n = 0; n < 40; ++n) {
    const Vec3 lo = point(6);
    const double side = number(0, 3);
    const Box box{lo, lo + Vec3{side, side, side}};
    for (const int channel : {0, 1}) {
      const Interval range = source->range(channel, box);
      for (int i = 0; i < 10; ++i) {
        const Vec3 p = lo + Vec3{number(0, side), number(0, side), number(0, side)};
        EXPECT_TRUE(range.contains(source->sample(channel, p)));
      }
    }
  }
}

// Compares points near the surface, where triangles leave a doubt, with the library's classifier, for planes,
// cylinders, cones, spheres, tori and splines.
TEST_F(CadSources, ExactOnesAreInsideWhereTheLibrarySaysSo) {
  for (const char* name : {"tests/cad/block_in_inches.step", "tests/cad/assembly.step", "tests/cad/all_surfaces.step",
                           "examples/models/bracket.step"}) {
    const auto solids = cad::read_solids(source_file(name));
    const double deflection = 0.05;
    const auto source = make_exact_source(name, solids, {}, deflection).source;
    const int inside = source->channel("inside");
    for (const cad::SolidPtr& solid : solids) {
      const auto query = solid->query();
      const cad::Triangles mesh = solid->triangulate(deflection);
      for (int n = 0; n < 400; ++n) {
        const auto& corners =
            mesh.triangles[std::uniform_int_distribution<size_t>(0, mesh.triangles.size() - 1)(random_)];
        const double s = number(0, 1), t = number(0, 1 - s);
        const Vec3 a = mesh.vertices[corners[0]], b = mesh.vertices[corners[1]], c = mesh.vertices[corners[2]];
        const Vec3 aside{number(-0.2, 0.2), number(-0.2, 0.2), number(-0.2, 0.2)};
        const Vec3 p = a + s * (b - a) + t * (c - a) + aside;
        const auto holds = [&](const cad::SolidPtr& other) {
          return other == solid ? query->is_inside(p) : other->bounds.contains(p) && other->query()->is_inside(p);
        };
        EXPECT_EQ(source->sample(inside, p), std::ranges::any_of(solids, holds) ? 1 : 0)
            << name << ' ' << p.x << ' ' << p.y << ' ' << p.z;
      }
    }
  }
}

// A cube of side 2 around `center` that leaves out some of its triangles, as a library might.
class Cube : public cad::Solid {
 public:
  Cube(Vec3 center, size_t left_out) : center_(center), left_out_(left_out) {
    name = "cube";
    bounds = Box{center - Vec3{1, 1, 1}, center + Vec3{1, 1, 1}};
  }
  cad::Triangles triangulate(double) const override {
    cad::Triangles cube = cube_triangles();
    cube.triangles.resize(cube.triangles.size() - left_out_);
    cube.faces.resize(cube.triangles.size());
    return cube;
  }
  std::vector<cad::FaceMesh> face_meshes(double, cad::FaceExtent) const override { return {}; }
  std::unique_ptr<cad::Query> query() const override { return std::make_unique<CubeQuery>(center_); }

 private:
  struct CubeQuery : cad::Query {
    explicit CubeQuery(Vec3 at) : center(at) {}
    bool is_inside(Vec3 p) override { return away(p) <= 0; }
    double surface_distance(Vec3 p) override { return std::abs(away(p)); }
    std::optional<cad::FaceSide> side_of_face(uint32_t face, Vec3 p, double) override {
      const int axis = static_cast<int>(face) / 2;
      Vec3 normal;
      normal[axis] = face % 2 == 0 ? -1 : 1;
      return cad::FaceSide{dot(normal, p - center) - 1, normal};
    }
    double away(Vec3 p) const {
      const Vec3 q = p - center;
      const Vec3 over{std::abs(q.x) - 1, std::abs(q.y) - 1, std::abs(q.z) - 1};
      const double most = std::max({over.x, over.y, over.z});
      return most <= 0 ? most : length(Vec3{std::max(over.x, 0.0), std::max(over.y, 0.0), std::max(over.z, 0.0)});
    }
    Vec3 center;
  };

  cad::Triangles cube_triangles() const {
    cad::Triangles cube;
    for (int n = 0; n < 8; ++n)
      cube.vertices.push_back(center_ + Vec3{n & 1 ? 1.0 : -1.0, n & 2 ? 1.0 : -1.0, n & 4 ? 1.0 : -1.0});
    cube.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    cube.faces = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
    return cube;
  }

  Vec3 center_;
  size_t left_out_;
};

cad::SolidPtr cube(Vec3 center, size_t left_out = 0) { return std::make_shared<Cube>(center, left_out); }

TEST(CadGaps, AreReportedWithTheirSolid) {
  EXPECT_TRUE(make_triangle_source("cubes", {cube({}), cube({2, 0, 0})}, {}, 0.1).open.empty());
  const auto open = make_triangle_source("cubes", {cube({}), cube({0, 0, 3}, 2)}, {}, 0.1).open;
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].name, "cube");
  EXPECT_EQ(open[0].edges.count, 4u);
  // The face at z = 4, whose sides are 2 mm apart, is missing.
  EXPECT_EQ(open[0].edges.example[0].z, 4);
  EXPECT_NEAR(open[0].edges.gap_mm, 2, 1e-12);
}

TEST(CadGaps, OfExactSolidsMatterWhereTheSurfaceIsNotQueried) {
  EXPECT_EQ(make_exact_source("cube", {cube({}, 2)}, {}, 0.1).open.size(), 1u);
  // The surface is queried within four deflections.
  EXPECT_TRUE(make_exact_source("cube", {cube({}, 2)}, {}, 1).open.empty());
}

// The doubtful volume of a cube is its area times twice four deflections.
TEST(CadDoubt, IsAsWideAsTrianglesMayBeOff) {
  const CadSource made = make_exact_source("cube", {cube({})}, {}, 0.01);
  EXPECT_NEAR(made.doubtful_mm3, 24 * 2 * 0.04, 1e-12);
  ASSERT_NEAR(static_cast<double>(made.doubtful_points.size()), 500, 1);
  for (const Vec3& p : made.doubtful_points)
    EXPECT_NEAR(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1, 0.04);
  EXPECT_GT(measure_doubtful_seconds(made), 0);
}

// The cubes touch, lie apart and overlap; a point is inside if it is inside of one of them.
TEST(CadSolids, TogetherAreWhatEachOfThemIs) {
  const std::vector<cad::SolidPtr> cubes{cube({}), cube({2, 0, 0}), cube({0, 5, 0}), cube({0.5, 0.5, 1.5})};
  const auto source = make_exact_source("cubes", cubes, {}, 0.05).source;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> wide(-3, 7);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p{wide(random), wide(random), wide(random)};
    double least = Box::inf;
    for (const cad::SolidPtr& one : cubes) {
      const auto query = one->query();
      const double distance = query->surface_distance(p);
      least = std::min(least, query->is_inside(p) ? -distance : distance);
    }
    EXPECT_EQ(source->sample(source->channel("distance"), p), least);
    EXPECT_EQ(source->sample(source->channel("inside"), p), least <= 0 ? 1 : 0);
  }
}

}  // namespace ombre::importing
