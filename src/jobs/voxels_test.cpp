// Tests volumes, fractions and transforms of designs against mathematics.
#include <cmath>
#include <map>
#include <numbers>

#include "base/system/tasks.h"
#include "base/system/test_source_files.h"
#include "jobs/test_designs.h"
#include "load/find_printer.h"
#include "program/evaluate.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

using std::numbers::pi;

std::string boxed(double half, double pitch, const std::string& body) {
  // The box is off centre, so that no symmetry of the lattice helps or harms.
  const std::string h = std::to_string(half), p = std::to_string(pitch);
  return "root((-" + h + "-0.0137, -" + h + "-0.0311, -" + h + "-0.0223), (" + h + ", " + h + ", " + h + "), (" + p +
         ", " + p + ", " + p + ")) {" + body + "}";
}

// Checks a volume. Counting centres has the error of a sum of independent errors of the surface's voxels: for an area A
// and pitch h about 0.3 h^2 sqrt(A), by the deviation of a uniform fraction of each voxel.
void expect_volume(const std::string& body, double half, double volume, double area) {
  for (const double h : {0.4, 0.2, 0.1}) {
    const Voxels voxels = slice_text(boxed(half, h, body));
    EXPECT_NEAR(voxels.volume(), volume, 4 * 0.3 * h * h * std::sqrt(area)) << body << " at " << h;
  }
}

}  // namespace

TEST(Volumes, Sphere) { expect_volume("sphere(4.1);", 5, 4 * pi / 3 * std::pow(4.1, 3), 4 * pi * 4.1 * 4.1); }
TEST(Volumes, TiltedTorus) {
  expect_volume("rotate(31, 17, 5) { torus(4, 1.3); }", 6, 2 * pi * pi * 4 * 1.3 * 1.3, 4 * pi * pi * 4 * 1.3);
}
TEST(Volumes, TiltedCylinder) {
  expect_volume("rotate(23, 41, 7) { cylinder(2.1, 6.3); }", 5, pi * 2.1 * 2.1 * 6.3, 2 * pi * 2.1 * (2.1 + 6.3));
}
TEST(Volumes, TiltedCone) {
  const double slant = std::hypot(6, 2);
  expect_volume("rotate(33, 12, 7) { cone(3, 1, 6); }", 5, pi * 6 / 3 * (9 + 3 + 1), pi * (9 + 1) + pi * 4 * slant);
}
TEST(Volumes, TiltedBox) { expect_volume("rotate(33, 12, 7) { rectprism(4, 5, 3); }", 5, 60, 2 * (20 + 12 + 15)); }
TEST(Volumes, Ellipsoid) { expect_volume("ellipsoid((4, 3, 2));", 5, 4 * pi / 3 * 24, 111.6); }
TEST(Volumes, RoundStrut) {
  expect_volume("strut((-2, -1, -1), (2, 2, 1), 1.1, caps=\"round\");", 5,
                pi * 1.21 * std::sqrt(29) + 4 * pi / 3 * 1.331, 2 * pi * 1.1 * (std::sqrt(29) + 2.2));
}

// The gyroid's two sides are congruent, so the level 0 halves a cell. The area of the gyroid in a cell of length 1 is
// 3.0915 (Schnering and Nesper 1991).
TEST(Volumes, GyroidHalvesItsCells) {
  const double side = 8;
  const std::string body =
      "intersection() { cube(8); function(\"sin(pi/2*x)*cos(pi/2*y) + sin(pi/2*y)*cos(pi/2*z) + "
      "sin(pi/2*z)*cos(pi/2*x)\"); }";
  expect_volume(body, 5, side * side * side / 2, 3.0915 * 16 * 8 + 6 * 32);
}

// The file is an icosahedron, whose volume is known; the divergence theorem gives it from the file's triangles.
TEST(Volumes, MeshUnderAnAffineMap) {
  const double phi = std::numbers::phi;
  const double v[12][3] = {{-1, phi, 0},  {1, phi, 0},  {-1, -phi, 0}, {1, -phi, 0}, {0, -1, phi},  {0, 1, phi},
                           {0, -1, -phi}, {0, 1, -phi}, {phi, 0, -1},  {phi, 0, 1},  {-phi, 0, -1}, {-phi, 0, 1}};
  const int f[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  const std::string path = testing::TempDir() + "icosahedron.off";
  std::ofstream file(path);
  file << "OFF\n12 20 0\n";
  file.precision(17);
  for (const auto& p : v) file << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& t : f) file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  file.close();
  // An icosahedron of edge a = 2 has the volume 5/12 (3 + sqrt 5) a^3 and the area 5 sqrt 3 a^2.
  const double volume = 5.0 / 12 * (3 + std::sqrt(5.0)) * 8, area = 5 * std::sqrt(3.0) * 4;
  expect_volume("rotate(10, 20, 30) { scale(2, -1.5, 1) { mesh(\"" + path + "\"); } }", 5, volume * 3, area * 2.6);
  std::remove(path.c_str());
}

// Figure 12 of the 2023 paper: designs are affine-invariant.
TEST(Transforms, RotatedAndRotatedBackIsThePlainDesign) {
  const std::string shape = "difference() { rectprism(7, 5, 3, \"red\"); cylinder(1.3, 9); }";
  const Voxels plain = slice_text(boxed(5, 0.1, shape));
  const Voxels turned = slice_text(
      boxed(5, 0.1, "rotate(axis=(1, 2, 3), deg=33.3) { rotate(axis=(1, 2, 3), deg=-33.3) {" + shape + "} }"));
  size_t different = 0;
  for (size_t n = 0; n < plain.ids.size(); ++n) different += plain.ids[n] != turned.ids[n];
  EXPECT_EQ(different, 0u);  // no centre lies within rounding of the surface here
}

TEST(Fractions, FollowTheGrade) {
  // Eqs 2 and 3 of the 2023 paper.
  const Voxels voxels = slice_text(
      "root((-5, -5, -5), (5, 5, 5), (0.1, 0.1, 0.1)) { fgrade([\"1/(1 + e^x)\", \"-1/(1 + e^x) + 1\"], [\"red\", "
      "\"blue\"], \"prob\") { cube(10); } }");
  ASSERT_EQ(voxels.ids.size(), 1000000u);
  const auto integral = [](double x) { return x - std::log1p(std::exp(x)); };  // integral of 1/(1 + e^x)
  for (int64_t i = 0; i < 100; ++i) {
    double red = 0;
    for (int64_t k = 0; k < 100; ++k)
      for (int64_t j = 0; j < 100; ++j) red += voxels.at(i, j, k) == voxels.id("red");
    const double lo = -5 + 0.1 * static_cast<double>(i);
    const double share = (integral(lo + 0.1) - integral(lo)) / 0.1;
    EXPECT_NEAR(red / 10000, share, 4 * std::sqrt(share * (1 - share) / 10000) + 1e-4) << i;
  }
}

TEST(Fractions, OfSeveralMaterialsAreIndependentOfTheNeighbours) {
  const Voxels voxels = slice_text(
      "root((0, 0, 0), (10, 10, 10), (0.1, 0.1, 0.1)) { material([\"red\", \"blue\", \"green\"], [0.2, 0.3, 0.5]) { "
      "translate(5, 5, 5) { cube(10); } } }");
  const std::map<std::string, double> shares{{"red", 0.2}, {"blue", 0.3}, {"green", 0.5}};
  const double n = 1e6;
  for (const auto& [a, share_a] : shares) {
    double count = 0;
    for (const MaterialId id : voxels.ids) count += id == voxels.id(a);
    EXPECT_NEAR(count / n, share_a, 4 * std::sqrt(share_a * (1 - share_a) / n));
    for (const auto& [b, share_b] : shares) {
      // The joint share of pairs of neighbours along each axis is the product of their shares.
      for (int axis = 0; axis < 3; ++axis) {
        double pairs = 0, total = 0;
        for (int64_t k = 0; k < 99; ++k)
          for (int64_t j = 0; j < 99; ++j)
            for (int64_t i = 0; i < 99; ++i) {
              total += 1;
              pairs += voxels.at(i, j, k) == voxels.id(a) &&
                       voxels.at(i + (axis == 0), j + (axis == 1), k + (axis == 2)) == voxels.id(b);
            }
        const double joint = share_a * share_b;
        EXPECT_NEAR(pairs / total, joint, 5 * std::sqrt(joint * (1 - joint) / total)) << a << b << axis;
      }
    }
  }
}

TEST(Fractions, ThresholdIsExact) {
  const Voxels voxels = slice_text(
      "root((0, 0, 0), (10, 1, 1), (0.1, 0.1, 0.1)) { fgrade([\"x\", \"5\"], [\"red\", \"blue\"], \"thresh\") { "
      "function(\"-1\"); } }");
  for (int64_t i = 0; i < 100; ++i)
    EXPECT_EQ(voxels.at(i, 0, 0), voxels.id(0.1 * static_cast<double>(i) + 0.05 >= 5 ? "red" : "blue")) << i;
}

TEST(Layers, DoNotDependOnHowTheyAreGrouped) {
  const std::string design = boxed(5, 0.1,
                                   "fgrade([\"0.5 + x/10\", \"0.5 - x/10\"], [\"red\", \"blue\"], \"prob\") { union() "
                                   "{ sphere(3); translate(2, 1, 0) { torus(2.5, 0.7); } mesh(\"" +
                                       source_file("examples/models/tetrahedron.off") + "\"); } }");
  const Voxels by_8 = slice_text(design), by_1 = slice_text(design, {}, 1), by_13 = slice_text(design, {}, 13);
  EXPECT_TRUE(by_8.ids == by_1.ids);
  EXPECT_TRUE(by_8.ids == by_13.ids);
}

TEST(Layers, MayBeQueriedBySeveralThreadsAtOnce) {
  Diagnostics diagnostics;
  const LoadedPtr loaded =
      load_text("fgrade([\"0.5 + d/10\", \"0.5 - d/10\"], [\"red\", \"blue\"], \"prob\") { mesh(\"" +
                    source_file("examples/models/tetrahedron.off") + "\"); }",
                diagnostics);
  const auto plan = plan_slice(loaded, {}, diagnostics);
  ASSERT_TRUE(plan) << to_text(diagnostics);
  const int64_t count = std::min<int64_t>(16, plan->request.lattice.count[2]);
  std::vector<std::vector<MaterialId>> together(static_cast<size_t>(count));
  run_parallel(together.size(), 4, [&](size_t k) {
    together[k] = unpack(plan->producer(static_cast<int64_t>(k), static_cast<int64_t>(k) + 1, nullptr));
  });
  for (size_t k = 0; k < together.size(); ++k)
    EXPECT_TRUE(together[k] == unpack(plan->producer(static_cast<int64_t>(k), static_cast<int64_t>(k) + 1, nullptr)))
        << k;
}

// Tiles, row spans and shortened programs give what the reference gives at every voxel.
TEST(Layers, AgreeWithTheReferencePointByPoint) {
  const std::string body =
      "difference() { union(materials=\"first\") { cube(4, \"red\"); rotate(20, 30, 40) { translate(2, 0, 0) { "
      "cylinder(1, 5, \"blue\"); } } function(\"x^2+y^2*z-3\", \"green\"); } torus(2, 0.5); negate() { sphere(4.5); } "
      "}";
  Diagnostics diagnostics;
  const std::string text = boxed(5, 0.23, body);
  const Voxels voxels = slice_text(text);
  const LoadedPtr loaded = load_text(text, diagnostics);
  std::vector<double> values;
  const auto built = build_flat_program(loaded->design, diagnostics);
  const auto& program = built->materials.program;
  for (int64_t k = 0; k < voxels.lattice.count[2]; ++k)
    for (int64_t j = 0; j < voxels.lattice.count[1]; ++j)
      for (int64_t i = 0; i < voxels.lattice.count[0]; ++i) {
        evaluate_point(program, voxels.lattice.center(i, j, k), values);
        MaterialId expected = 0;
        if (values[program.outputs[0]] != 0)
          for (size_t m = 0; m < built->materials.materials.size(); ++m)
            if (values[program.outputs[m + 1]] == 1) expected = built->materials.materials[m];
        ASSERT_EQ(voxels.at(i, j, k), expected) << i << " " << j << " " << k;
      }
}

// The tray of a J750 at 600 x 300 dpi has 11575 x 4606 voxels, and parts keep theirs on it.
TEST(Lattices, CoverTheTray) {
  Diagnostics diagnostics;
  PlanOptions options;
  options.printer = *find_printer("j750", diagnostics);
  options.printer_given = true;
  const LoadedPtr loaded = load_text("translate(20, 30, 1) rectprism(6, 4, 2, \"red\");", diagnostics);
  const auto part = plan_slice(loaded, options, diagnostics);
  options.whole_tray = true;
  const auto tray = plan_slice(loaded, options, diagnostics);
  options.whole_tray = false;
  options.place = voxel::Placement::center;
  const auto center = plan_slice(loaded, options, diagnostics);
  ASSERT_TRUE(part && tray && center) << to_text(diagnostics);
  for (const auto* plan : {&*tray, &*center}) {
    const auto& lattice = plan->request.lattice;
    EXPECT_EQ(lattice.count[0], 11575);
    EXPECT_EQ(lattice.count[1], 4606);
    EXPECT_EQ(lattice.count[2], 75);  // up to the part's top, 2 mm in layers of 27 um
    for (int axis = 0; axis < 3; ++axis) {
      const double voxels =
          (part->request.lattice.origin[axis] - lattice.origin[axis]) / lattice.pitch[static_cast<size_t>(axis)].mm();
      EXPECT_NEAR(voxels, std::round(voxels), 1e-6);
    }
  }
  // The part lies at the design's own place, to the nearest voxel, or in the middle.
  EXPECT_NEAR(tray->request.lattice.origin.x, 0, 0.0212);
  EXPECT_NEAR(center->request.lattice.box().center().x, 20, 0.0424);
  EXPECT_NEAR(center->request.lattice.box().center().y, 30, 0.0848);
}

}  // namespace ombre::compile
