// Tests meshes of designs against mathematics.
#include "jobs/mesh/mesh_job.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "jobs/test_designs.h"
#include "load/load.h"

namespace ombre::compile {
namespace {

using std::numbers::pi;
using Triangle = std::array<uint32_t, 3>;

MeshedDesign mesh_text(const std::string& text, const MeshRequest& request = {}) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  auto made = loaded ? mesh_design(*loaded, request, diagnostics) : std::nullopt;
  EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics);
  return made ? std::move(*made) : MeshedDesign{};
}

MeshRequest cells_of(double cell_mm, double tolerance_mm) {
  MeshRequest request;
  request.cell_mm = cell_mm;
  request.tolerance_mm = tolerance_mm;
  return request;
}

// Checks that every edge has two triangles, which run along it in opposite directions, and that around every vertex
// there is one fan.
void expect_manifold(const surface::Body& body) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> third;  // the third vertex of the triangle at a directed edge
  std::vector<size_t> triangles_at(body.vertices.size());
  for (const Triangle& t : body.triangles)
    for (size_t n = 0; n < 3; ++n) {
      ASSERT_TRUE(third.emplace(std::pair(t[n], t[(n + 1) % 3]), t[(n + 2) % 3]).second);
      ++triangles_at[t[n]];
    }
  for (const auto& [edge, corner] : third) ASSERT_TRUE(third.contains({edge.second, edge.first}));
  for (const Triangle& t : body.triangles) {
    size_t fan = 0;
    uint32_t next = t[1];
    do {
      next = third.at({t[0], next});
      ++fan;
    } while (next != t[1]);
    ASSERT_EQ(fan, triangles_at[t[0]]);
  }
}

double volume(const MeshedDesign& made) {
  double sum = 0;
  for (const RegionBody& body : made.bodies) sum += body.volume_mm3;
  return sum;
}

// Calls f with points of each triangle: corners, middles of sides, its middle.
template <class F>
void each_point(const surface::Body& body, F f) {
  for (const Triangle& t : body.triangles) {
    const Vec3 a = body.vertices[t[0]], b = body.vertices[t[1]], c = body.vertices[t[2]];
    for (const Vec3 p : {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (1.0 / 3) * (a + b + c)}) f(p);
  }
}

double distance(Vec3 p, Vec3 from, Vec3 to) {
  const Vec3 along = to - from;
  const double t = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
  return length(p - from - t * along);
}

double distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const bool is_over = dot(cross(b - a, p - a), normal) >= 0 && dot(cross(c - b, p - b), normal) >= 0 &&
                       dot(cross(a - c, p - c), normal) >= 0;
  if (is_over && length(normal) > 0) return std::abs(dot(p - a, normal)) / length(normal);
  return std::min({distance(p, a, b), distance(p, b, c), distance(p, c, a)});
}

double distance(Vec3 p, const surface::Body& body) {
  double nearest = 1e300;
  for (const Triangle& t : body.triangles)
    nearest = std::min(nearest, distance(p, body.vertices[t[0]], body.vertices[t[1]], body.vertices[t[2]]));
  return nearest;
}

// Returns the distance to a cylinder around the origin, negative inside.
double distance_to_cylinder(Vec3 p, Vec3 axis, double radius, double half_length) {
  const double along = dot(p, axis), beyond = std::abs(along) - half_length;
  const double beside = length(p - along * axis) - radius;
  if (beyond > 0 && beside > 0) return std::hypot(beyond, beside);
  return std::max(beyond, beside);
}

using Place = std::array<double, 3>;
std::set<Place> places_where(const surface::Body& body, const std::function<bool(Vec3)>& wanted) {
  std::set<Place> places;
  for (const Vec3 v : body.vertices)
    if (wanted(v)) places.insert({v.x, v.y, v.z});
  return places;
}

}  // namespace

TEST(Mesh, OfASphereStaysWithinTheTolerance) {
  for (const double tolerance : {0.1, 0.02, 0.005}) {
    const MeshedDesign made = mesh_text("sphere(5);", cells_of(0.2, tolerance));
    ASSERT_EQ(made.bodies.size(), 1u);
    const surface::Body& body = made.bodies[0].body;
    expect_manifold(body);
    each_point(body, [&](Vec3 p) { EXPECT_NEAR(length(p), 5, tolerance); });
    EXPECT_NEAR(made.bodies[0].volume_mm3, 4 * pi / 3 * 125, 4 * pi * 25 * tolerance);
    EXPECT_EQ(made.report.folded, 0u);
  }
}

// Halving cells divides the error of the area at least by four. Volumes are fitted by a rule that is exact for
// quadratics, so their error falls with the fourth power: at least by eight.
TEST(Mesh, ConvergesWithTheCells) {
  double volume_error = 5e-4, area_error = 1e300;
  for (const double cell : {0.8, 0.4, 0.2}) {
    MeshRequest request = cells_of(cell, 1);
    request.join_flat = false;
    const RegionBody body = mesh_text("rotate(12, 25, 40) torus(5, 2);", request).bodies.at(0);
    const double v = std::abs(body.volume_mm3 / (2 * pi * pi * 5 * 4) - 1);
    const double a = std::abs(body.area_mm2 / (4 * pi * pi * 5 * 2) - 1);
    EXPECT_LT(v, volume_error);
    EXPECT_LT(a, 0.3 * area_error);
    volume_error = v / 8;
    area_error = a;
  }
}

TEST(Mesh, KeepsTheVolumeOfCurvedSolids) {
  const std::map<std::string, double> solids{{"sphere(10);", 4 * pi / 3 * 1000},
                                             {"rotate(10, 20, 0) torus(10, 2);", 2 * pi * pi * 10 * 4},
                                             {"rotate(10, 20, 0) cylinder(1, 20);", 20 * pi}};
  for (const auto& [text, volume] : solids)
    for (const double tolerance : {0.01, 0.05}) {  // cells by themselves, and joined
      const double found = mesh_text(text, cells_of(0.2, tolerance)).bodies.at(0).volume_mm3;
      EXPECT_NEAR(found / volume, 1, 2e-4) << text << ", tolerance " << tolerance;
    }
}

// Solids of planes have the triangles that their corners need, by Euler's formula 2 V - 4, wherever they lie on the
// grid.
TEST(Mesh, OfPlanesHasNoMoreTrianglesThanTheyNeed) {
  struct Case {
    std::string text;
    size_t triangles;
    double volume_mm3;
  };
  const Case cases[] = {
      {"rectprism(20, 12, 8);", 12, 1920},
      {"rotate(0, 0, 30) rectprism(20, 12, 8);", 12, 1920},
      {"rotate(10, 20, 30) rectprism(20, 12, 8);", 12, 1920},
      // A plane cuts off an edge: a prism over a triangle with legs of 4 mm.
      {"difference() { rectprism(20, 12, 8); translate(10, 0, 4) rotate(0, 45, 0) rectprism(5.656854249492381, 40, "
       "5.656854249492381); }",
       16, 1920 - 8 * 12},
  };
  for (const Case& c : cases)
    for (const double tolerance : {0.02, 0.1, 0.5}) {
      MeshRequest request;
      request.tolerance_mm = tolerance;
      const MeshedDesign made = mesh_text(c.text, request);
      ASSERT_EQ(made.bodies.size(), 1u);
      expect_manifold(made.bodies[0].body);
      EXPECT_EQ(made.bodies[0].body.triangles.size(), c.triangles) << c.text << ", tolerance " << tolerance;
      EXPECT_NEAR(made.bodies[0].volume_mm3, c.volume_mm3, 1e-6 * c.volume_mm3) << c.text;
    }
}

// Two blocks of two materials share the face between them, corner by corner.
TEST(Mesh, OfTwoBlocksThatTouchHasTwelveTrianglesEach) {
  for (const std::string turn : {"", "rotate(0, 0, 30) "})
    for (const double tolerance : {0.02, 0.1}) {
      MeshRequest request;
      request.tolerance_mm = tolerance;
      request.by_material = true;
      const MeshedDesign made = mesh_text(
          turn + R"(union() { translate(-5, 0, 0) cube(10, "red"); translate(5, 0, 0) cube(10, "blue"); })", request);
      ASSERT_EQ(made.bodies.size(), 2u);
      for (const RegionBody& body : made.bodies) {
        expect_manifold(body.body);
        EXPECT_EQ(body.body.triangles.size(), 12u) << turn << tolerance;
        EXPECT_NEAR(body.volume_mm3, 1000, 1e-3);
      }
    }
}

// The blue block is far smaller than the spacing of the samples for mixtures.
TEST(Mesh, OfSeveralMaterialsHasABodyForEach) {
  MeshRequest request = cells_of(0.02, 0.01);
  request.usual = UsualRegions::separate;
  const std::string speck = R"(union(materials="first") { translate(1.03, 0, 0) cube(0.1, "blue"); cube(4, "red"); })";
  const MeshedDesign made = mesh_text(speck, request);
  EXPECT_EQ(made.materials.names, (std::vector<std::string>{"red", "blue"}));
  EXPECT_FALSE(made.materials.are_mixed);
  ASSERT_EQ(made.bodies.size(), 2u);
  std::map<std::string, double> volumes;
  for (const RegionBody& body : made.bodies) volumes[body.region.name] = body.volume_mm3;
  EXPECT_NEAR(volumes["red"], 63.999, 1e-4);
  EXPECT_NEAR(volumes["blue"], 0.001, 1e-6);
  request.usual = UsualRegions::joined;
  EXPECT_EQ(mesh_text(speck, request).bodies.size(), 1u);
}

// Half of the cube is void, and a third of it is mostly void where it is mixed.
TEST(Mesh, LeavesOutWhatIsMostlyVoid) {
  MeshRequest whole = cells_of(0.5, 0.05);
  whole.usual = UsualRegions::as_requested;
  const std::string half = "cube(10, coordinates().place.x < 0 ? \"void\" : \"red\");";
  EXPECT_NEAR(volume(mesh_text(half, whole)), 500, 1e-6);
  EXPECT_NEAR(volume(mesh_text(half, cells_of(0.5, 0.05))), 500, 1e-6);
  const std::string graded = "cube(12, mix(\"void\", \"red\", 0.5 + (coordinates().place.x + 2) / 12));";
  const MeshedDesign made = mesh_text(graded, whole);
  ASSERT_EQ(made.bodies.size(), 1U);
  EXPECT_NEAR(made.bodies[0].volume_mm3, 8 * 12 * 12, 1e-3);
}

TEST(Mesh, OfMixturesHasBodiesByBands) {
  MeshRequest request = cells_of(0.5, 0.1);
  request.usual = UsualRegions::separate;
  // A fraction rises evenly over 20 mm, so there are four bands of 250 mm3.
  const MeshedDesign two =
      mesh_text(R"(fgrade(["x/20 + 0.5", "0.5 - x/20"], ["red", "blue"]) rectprism(20, 10, 5);)", request);
  EXPECT_TRUE(two.is_by_bands && two.materials.are_mixed);
  ASSERT_EQ(two.bodies.size(), 4u);
  for (const RegionBody& body : two.bodies) EXPECT_NEAR(body.volume_mm3, 250, 1e-3);
  // A third material beside the mixture is a body of its own.
  const MeshedDesign three = mesh_text(
      R"(union(materials="first") { fgrade(["x/20 + 0.5", "0.5 - x/20"], ["red", "blue"]) rectprism(20, 10, 5);
         translate(0, 20, 0) cube(4, "gray"); })",
      request);
  EXPECT_NEAR(volume(three), 1064, 1e-2);
  EXPECT_TRUE(
      std::ranges::any_of(three.bodies, [](const RegionBody& b) { return std::abs(b.volume_mm3 - 64) < 1e-3; }));
}

// Cells are 0.4 times the radius long. The intersection of two crossing cylinders is Steinmetz's solid.
TEST(Mesh, KeepsTheVolumeOfStrutsOfFewCells) {
  const double r = 0.7, long_mm = 6;
  const double alone = pi * r * r * long_mm, shared = 16.0 / 3 * r * r * r;
  const std::string strut = "cylinder(0.7, 6);";
  const std::map<std::string, double> solids{
      {"rotate(50, 30, 10) " + strut, alone},
      {"rotate(35, 45, 0) " + strut, alone},
      {"rotate(50, 30, 10) union() { " + strut + " rotate(90, 0, 0) " + strut + " }", 2 * alone - shared}};
  for (const auto& [text, volume] : solids) {
    const double found = mesh_text(text, cells_of(0.28, 0.07)).bodies.at(0).volume_mm3;
    EXPECT_NEAR(found / volume, 1, 1e-3) << text;
  }
}

TEST(Mesh, OfATiltedBoxHasItsEdgesAndCorners) {
  const double to_corner = std::sqrt(49 + 7.5 * 7.5 + 6.5 * 6.5);
  for (const bool join_flat : {false, true}) {
    MeshRequest request = cells_of(0.17, 0.02);
    request.join_flat = join_flat;
    const MeshedDesign made = mesh_text("rotate(33, 12, 7) rectprism(14, 15, 13);", request);
    const surface::Body& body = made.bodies.at(0).body;
    expect_manifold(body);
    EXPECT_EQ(places_where(body, [&](Vec3 v) { return std::abs(length(v) - to_corner) < 1e-5; }).size(), 8u);
    EXPECT_NEAR(made.bodies[0].volume_mm3, 14 * 15 * 13, 1e-5 * 14 * 15 * 13);
    EXPECT_NEAR(made.bodies[0].area_mm2, 2 * (14 * 15 + 14 * 13 + 15 * 13), 1e-4 * 1174);
  }
}

// Faces have round coordinates, and cells a round size.
TEST(Mesh, OfACubeIsTheCube) {
  const MeshedDesign made = mesh_text("cube(20);", cells_of(0.5, 0.05));
  EXPECT_NEAR(made.bodies.at(0).volume_mm3, 8000, 1e-6);
  EXPECT_NEAR(made.bodies[0].area_mm2, 2400, 1e-6);
  EXPECT_EQ(made.bodies[0].body.triangles.size(), 12u);
}

// A cylinder is cut askew: the rim of the cut lies on both surfaces.
TEST(Mesh, OfACutCylinderHasASharpRim) {
  const MeshedDesign made =
      mesh_text("intersection() { cylinder(4, 20); rotate(30, 0, 0) rectprism(40, 40, 6); }", cells_of(0.1, 0.01));
  const surface::Body& body = made.bodies.at(0).body;
  expect_manifold(body);
  // The volume is the prism's height along the axis times the circle.
  const double height = 6 / std::cos(pi / 6);
  EXPECT_NEAR(made.bodies[0].volume_mm3, pi * 16 * height, 1e-3 * pi * 16 * height);
  EXPECT_NEAR(made.bodies[0].area_mm2, 2 * pi * 4 * height + 2 * pi * 16 / std::cos(pi / 6), 0.3);
}

// Two cylinders cross at 16 degrees: cells of the grid cannot follow the valley between them down to its ground.
TEST(Mesh, OfANarrowValleyStaysWithinTheTolerance) {
  const double tolerance = 0.04, radius = 2, half_length = 20, angle = pi * 8 / 180;
  const std::string text = "union() { rotate(0, 8, 0) cylinder(2, 40); rotate(0, -8, 0) cylinder(2, 40); }";
  MeshRequest request = cells_of(0.32, tolerance);
  request.threads = 1;
  const MeshedDesign made = mesh_text(text, request);
  const surface::Body& body = made.bodies.at(0).body;
  expect_manifold(body);
  EXPECT_EQ(made.report.farthest_in_tolerances, 1);
  EXPECT_EQ(made.report.intersections, 0u);
  const Vec3 one{std::sin(angle), 0, std::cos(angle)}, two{-one.x, 0, one.z};
  each_point(body, [&](Vec3 p) {
    EXPECT_LE(std::abs(std::min(distance_to_cylinder(p, one, radius, half_length),
                                distance_to_cylinder(p, two, radius, half_length))),
              tolerance);
  });
  // The ground of the valley is an ellipse.
  for (int n = 0; n < 100; ++n) {
    const double turn = 2 * pi * n / 100;
    const Vec3 ground{0, radius * std::cos(turn), radius * std::sin(turn) / std::sin(angle)};
    EXPECT_LE(distance(ground, body), tolerance) << n;
  }
  request.threads = 2;
  const MeshedDesign again = mesh_text(text, request);
  EXPECT_TRUE(again.bodies.at(0).body.vertices == body.vertices);
  EXPECT_TRUE(again.bodies.at(0).body.triangles == body.triangles);
}

TEST(Mesh, HasPocketsThatNoCornerOfACellSees) {
  constexpr double tolerance = 0.1, cell = 0.4, radius = 0.15;
  std::vector<Vec3> middles;
  std::string pockets;
  for (int n = 0; n < 10; ++n) {
    const Vec3 at{-4 + 0.83 * n, -2 + 0.37 * n, -1 + 0.29 * n};
    middles.push_back(at);
    pockets += "translate(" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(at.z) +
               ") sphere(" + std::to_string(radius) + ");";
  }
  const MeshedDesign made =
      mesh_text("difference() { cube(10); union() { " + pockets + " } }", cells_of(cell, tolerance));
  ASSERT_EQ(made.bodies.size(), 1u);
  const surface::Body& body = made.bodies[0].body;
  expect_manifold(body);
  for (const Vec3 middle : middles)
    for (const Vec3 way : {Vec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
      EXPECT_LE(distance(middle + radius * way, body), tolerance) << middle.x;
}

// Most thin parts lie between the corners of cells, and all cells have to be cut. A plate that contains no corner of a
// cell is missing beside a cube, and so is a slit of that width in a block.
TEST(Mesh, TellsWhatIsTooThinForItsCells) {
  const MeshRequest request = cells_of(0.8, 0.2);
  const std::string cube = "translate(0, 0, 20) cube(10);";
  const MeshedDesign plate = mesh_text("translate(0, 0, 0.013) rectprism((100, 100, 0.05));" + cube, request);
  EXPECT_GT(plate.report.lost.places, 100 * 100 / (0.8 * 0.8) / 2);
  EXPECT_NEAR(plate.report.lost.first.z, 0.013, 0.026);
  EXPECT_NEAR(volume(plate), 1000, 1e-6);
  const MeshedDesign block =
      mesh_text("difference() { cube(20); translate(0, 0, 0.13) rectprism((10, 10, 0.05)); }", request);
  EXPECT_GT(block.report.lost.places, 0);
  EXPECT_NEAR(block.report.lost.first.z, 0.13, 0.026);
  EXPECT_EQ(mesh_text(cube + "sphere(5); translate(30, 0, 0) cylinder(0.5, 10);", request).report.lost.places, 0);
}

TEST(Mesh, OfSheetsThinnerThanCellsHasThemAll) {
  const MeshedDesign made = mesh_text("intersection() { cube(2); function(\"sin(4*pi*x)\"); }", cells_of(0.4, 0.02));
  EXPECT_EQ(made.report.farthest_in_tolerances, 1);
  ASSERT_EQ(made.bodies.size(), 1u);
  expect_manifold(made.bodies[0].body);
  EXPECT_NEAR(made.bodies[0].volume_mm3, 4, 1e-3 * 4);
  EXPECT_NEAR(made.bodies[0].area_mm2, 4 * 2 * (2 * 2 + 0.25 * 2 + 0.25 * 2), 1e-3 * 40);
}

// Inside and outside are congruent by a rotation about the middle.
TEST(Mesh, OfAGyroidFinerThanCellsIsHalfTheCube) {
  const MeshedDesign made = mesh_text(
      "intersection() { cube(3); function(\"sin(12*x)*cos(12*y) + sin(12*y)*cos(12*z) + sin(12*z)*cos(12*x)\"); }",
      cells_of(0.3, 0.02));
  EXPECT_EQ(made.report.farthest_in_tolerances, 1);
  EXPECT_EQ(made.report.intersections, 0u);
  expect_manifold(made.bodies.at(0).body);
  EXPECT_NEAR(made.bodies[0].volume_mm3, 13.5, 1e-3 * 13.5);
}

TEST(Mesh, OfAGyroidHalvesItsCells) {
  const MeshedDesign made = mesh_text(
      "intersection() { cube(8); function(\"sin(pi/2*x)*cos(pi/2*y) + sin(pi/2*y)*cos(pi/2*z) + "
      "sin(pi/2*z)*cos(pi/2*x)\"); }",
      cells_of(0.1, 0.01));
  expect_manifold(made.bodies.at(0).body);
  EXPECT_NEAR(made.bodies[0].volume_mm3, 256, 1e-4 * 256);
  // The area of the gyroid in a cell of length 1 is 3.0915 (Schnering and Nesper 1991); half of each face of the cube
  // is added.
  EXPECT_NEAR(made.bodies[0].area_mm2, 3.0915 * 16 * 8 + 6 * 32, 1e-3 * 587);
}

// Neighbours share their borders to the last bit, and fill the whole.
TEST(Mesh, OfBandsSharesTheirBorders) {
  for (const bool join_flat : {false, true}) {
    MeshRequest request = cells_of(0.3, 0.02);
    request.join_flat = join_flat;
    request.bands = BandRequest{4, {}, "red"};
    const MeshedDesign made =
        mesh_text("fgrade([\"x/10+0.5\", \"0.5-x/10\"], [\"red\", \"blue\"]) sphere(5);", request);
    ASSERT_EQ(made.bodies.size(), 4u);
    for (const RegionBody& body : made.bodies) expect_manifold(body.body);
    // A cap of height h has the volume pi h^2 (3 r - h) / 3.
    const double cap = pi * 2.5 * 2.5 * 12.5 / 3;
    EXPECT_NEAR(made.bodies[0].volume_mm3, cap, 0.5);
    EXPECT_NEAR(made.bodies[3].volume_mm3, cap, 0.5);
    for (size_t n = 0; n + 1 < 4; ++n) {
      const double x = 2.5 * (static_cast<double>(n) - 1);
      const auto on_border = [&](Vec3 v) { return std::abs(v.x - x) < 1e-6; };
      const auto left = places_where(made.bodies[n].body, on_border);
      EXPECT_GT(left.size(), 4u);
      EXPECT_TRUE(left == places_where(made.bodies[n + 1].body, on_border));
    }
  }
}

TEST(Mesh, OfRegionsAddsUpToTheWhole) {
  const std::string text =
      "fgrade([\"x/10+0.5\", \"0.5-x/10\"], [\"red\", \"blue\"]) rotate(20, 30, 40) torus(4, 1.5);";
  MeshRequest request = cells_of(0.06, 0.01);
  request.join_flat = false;
  const double whole = volume(mesh_text(text, request));
  request.bands = BandRequest{7, {}, ""};
  EXPECT_NEAR(volume(mesh_text(text, request)), whole, 2e-4 * whole);
}

// Materials jump at a slanted plane: the border is found without a value that goes through zero there.
TEST(Mesh, OfMaterialsMeetsWhereTheyJump) {
  MeshRequest request = cells_of(0.3, 0.02);
  request.by_material = true;
  const MeshedDesign made = mesh_text(
      "union() { intersection() { cube(10, \"red\"); rotate(0, 20, 0) translate(10, 0, 0) cube(20, \"red\"); }\n"
      "difference() { cube(10, \"blue\"); rotate(0, 20, 0) translate(10, 0, 0) cube(20, \"blue\"); } }",
      request);
  ASSERT_EQ(made.bodies.size(), 2u);
  for (const RegionBody& body : made.bodies) {
    expect_manifold(body.body);
    EXPECT_NEAR(body.volume_mm3, 500, 0.5);
    EXPECT_NEAR(body.area_mm2, 300 + 100 / std::cos(pi / 9), 1);
  }
  EXPECT_NEAR(volume(made), 1000, 1e-3);
}

// Cubes share an edge, or a corner.
TEST(Mesh, OfSolidsThatTouchIsManifold) {
  for (const char* text :
       {"union() { cube(4); translate(4, 4, 0) cube(4); }", "union() { cube(4); translate(4, 4, 4) cube(4); }"}) {
    const MeshedDesign made = mesh_text(text, cells_of(0.25, 0.01));
    for (const RegionBody& body : made.bodies) expect_manifold(body.body);
    EXPECT_NEAR(volume(made), 128, 0.3) << text;
  }
}

TEST(Mesh, EndsAtTheBoxOfRoot) {
  const MeshedDesign made =
      mesh_text("root((-2, -3, -1), (2, 3, 1), (0.1, 0.1, 0.1)) { sphere(50); }", cells_of(0.2, 0.01));
  EXPECT_NEAR(made.bodies.at(0).volume_mm3, 48, 1e-6);
}

TEST(Mesh, IsTheSameForAnyNumberOfThreads) {
  MeshRequest request = cells_of(0.2, 0.01);
  request.by_material = true;
  const std::string text = "fgrade([\"x/10+0.5\", \"0.5-x/10\"], [\"red\", \"blue\"]) torus(5, 2);";
  request.threads = 1;
  const MeshedDesign one = mesh_text(text, request);
  request.threads = 3;
  const MeshedDesign three = mesh_text(text, request);
  ASSERT_EQ(one.bodies.size(), three.bodies.size());
  for (size_t n = 0; n < one.bodies.size(); ++n) {
    EXPECT_TRUE(one.bodies[n].body.vertices == three.bodies[n].body.vertices);
    EXPECT_TRUE(one.bodies[n].body.triangles == three.bodies[n].body.triangles);
  }
}

TEST(Mesh, OfManyPartsKeepsThem) {
  const MeshedDesign made =
      mesh_text("union() { for (i = [0:9]) for (j = [0:9]) translate(3 * i, 3 * j, 0) sphere(1, \"red\"); }",
                cells_of(0.2, 0.02));
  EXPECT_NEAR(volume(made), 100 * 4 * pi / 3, 100 * 4 * pi * 0.02);
}

// The sides of the boxes make long decimals.
TEST(Mesh, OfPartsOfAnySize) {
  for (const char* side : {"7e-13", "1e-4", "0.0123456789", "1234.56789", "76543.21"}) {
    const MeshedDesign made = mesh_text("cube(" + std::string(side) + ");");
    const double volume_of_cube = std::pow(std::stod(side), 3);
    EXPECT_NEAR(volume(made), volume_of_cube, 1e-6 * volume_of_cube) << side;
  }
}

// The tolerance is larger than the parts, so whole surfaces are joined up to the largest cell.
TEST(Mesh, OfPartsSmallerThanTheToleranceEnds) {
  const MeshedDesign made = mesh_text("union() { sphere(0.3); translate(20, 0, 0) sphere(0.3); }", cells_of(0.2, 5));
  EXPECT_EQ(made.bodies.size(), 1u);
  expect_manifold(made.bodies[0].body);
}

// The middles of two balls of radius 3 are 4 apart, and the first has the lens between them, whose caps are 1 high.
// Solids in no part at the top level come first.
TEST(Mesh, ByPartsHasABodyForEachName) {
  MeshRequest request = cells_of(0.2, 0.01);
  request.by_part = true;
  const MeshedDesign made = mesh_text(
      "part(\"left\") sphere(3); translate(20, 0, 0) cube(2);"
      "union() { translate(4, 0, 0) part(\"right\") sphere(3); rotate(0, 0, 9) part(\"right\") translate(0, 9, 0) "
      "cube(1); }",
      request);
  ASSERT_EQ(made.bodies.size(), 3u);
  std::map<std::string, double> volumes;
  for (const RegionBody& body : made.bodies) {
    expect_manifold(body.body);
    volumes[body.region.name] = body.volume_mm3;
  }
  const double ball = 4 * pi / 3 * 27, lens = 2 * pi / 3 * (3 * 3 - 1);
  EXPECT_NEAR(volumes["rest"], 8, 1e-6);
  EXPECT_NEAR(volumes["left"], ball - lens, 0.005 * ball);
  EXPECT_NEAR(volumes["right"], ball + 1, 0.005 * ball);
}

TEST(Mesh, ByPartsNeedsNames) {
  MeshRequest request;
  request.by_part = true;
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text("sphere(3);", diagnostics);
  EXPECT_FALSE(mesh_design(*loaded, request, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("no part of the design has a name"), std::string::npos) << to_text(diagnostics);
}

TEST(Mesh, OfNothingIsAnError) {
  for (const auto& [of, message] : {std::pair("gold", "attribute \"gold\""), std::pair("red", "material \"red\"")}) {
    MeshRequest request;
    request.bands = BandRequest{4, {}, of};
    Diagnostics diagnostics;
    const LoadedPtr loaded = load_text("sphere(3, \"blue\");", diagnostics);
    EXPECT_FALSE(mesh_design(*loaded, request, diagnostics));
    EXPECT_NE(to_text(diagnostics).find(message), std::string::npos) << to_text(diagnostics);
  }
}

}  // namespace ombre::compile
