// Meshes of designs against mathematics.
#include "compile/mesh_job.h"

#include <map>
#include <numbers>

#include "compile/test_designs.h"

namespace ombre::compile {
namespace {

using std::numbers::pi;

MeshedDesign mesh_text(const std::string& text, const MeshRequest& request = {}) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  auto made = loaded ? mesh_design(*loaded, request, diagnostics) : std::nullopt;
  EXPECT_FALSE(diagnostics.has_errors());
  return made ? std::move(*made) : MeshedDesign{};
}

// Every edge has two triangles, one in each direction, and every vertex one fan.
void expect_manifold(const surface::Body& body) {
  std::map<std::pair<uint32_t, uint32_t>, int> directed;
  for (const auto& t : body.triangles)
    for (size_t n = 0; n < 3; ++n) ++directed[{t[n], t[(n + 1) % 3]}];
  for (const auto& [edge, count] : directed) {
    ASSERT_EQ(count, 1);
    const auto back = directed.find({edge.second, edge.first});
    ASSERT_TRUE(back != directed.end());
  }
}

void print(const char* name, const MeshedDesign& made, double volume, double area) {
  for (const RegionBody& b : made.bodies)
    std::printf(
        "%s %s: %zu triangles of %llu, volume %.6f / %.6f (%.2e), area %.5f / %.5f, mean points %llu, folded %llu\n",
        name, b.region.name.c_str(), b.body.triangles.size(),
        static_cast<unsigned long long>(made.report.full_triangles), b.volume_mm3, volume, b.volume_mm3 / volume - 1,
        b.area_mm2, area, static_cast<unsigned long long>(made.report.at_mean_points),
        static_cast<unsigned long long>(made.report.folded));
}

}  // namespace

TEST(MeshJob, Sphere) {
  for (const bool join : {false, true}) {
    MeshRequest r;
    r.join_flat = join;
    const MeshedDesign made = mesh_text("sphere(10);", r);
    print("sphere", made, 4 * pi / 3 * 1000, 4 * pi * 100);
    expect_manifold(made.bodies[0].body);
  }
}

TEST(MeshJob, TiltedBox) {
  for (const bool join : {false, true}) {
    MeshRequest r;
    r.join_flat = join;
    const MeshedDesign made = mesh_text("rotate(33, 12, 7) rectprism(14, 15, 13);", r);
    print("box", made, 14 * 15 * 13, 2 * (14 * 15 + 14 * 13 + 15 * 13));
    expect_manifold(made.bodies[0].body);
  }
}

TEST(MeshJob, Regions) {
  for (const bool join : {false, true}) {
    MeshRequest r;
    r.join_flat = join;
    r.bands = {4, {}, "red"};
    const MeshedDesign made = mesh_text("fgrade([\"x/20+0.5\", \"0.5-x/20\"], [\"red\", \"blue\"]) cube(20);", r);
    print("cube bands", made, 2000, 2 * (400 + 10 * 20));
    for (const auto& b : made.bodies) expect_manifold(b.body);
  }
}

TEST(MeshJob, Cube) {
  for (const char* text : {"cube(20);", "rectprism(20, 10, 10);",
                           "fgrade([\"x/20+0.5\", \"0.5-x/20\"], [\"red\", \"blue\"]) rectprism(20,10,10);"}) {
    MeshRequest r;
    r.join_flat = false;
    print(text, mesh_text(text, r), 2000, 1000);
    r.bands = {2, {}, ""};
    print(text, mesh_text(text, r), 2000, 1000);
  }
}

TEST(MeshJob, Gyroid) {
  for (const bool join : {false, true}) {
    MeshRequest r;
    r.join_flat = join;
    const MeshedDesign made = mesh_text(
        "intersection() { cube(8); function(\"sin(pi/2*x)*cos(pi/2*y) + sin(pi/2*y)*cos(pi/2*z) + "
        "sin(pi/2*z)*cos(pi/2*x)\"); }",
        r);
    print("gyroid", made, 256, 3.0915 * 16 * 8 + 6 * 32);
    expect_manifold(made.bodies[0].body);
  }
}

}  // namespace ombre::compile
