// Tests designs with struts that are written as beams and read again.
#include <filesystem>

#include "base/system/test_source_files.h"
#include "formats/containers/file.h"
#include "formats/mesh/mesh.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/read_mesh.h"
#include "jobs/mesh/beam_document.h"
#include "jobs/test_designs.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

class Beams : public testing::Test {
 protected:
  Beams() : path_(testing::TempDir() + "beams" + std::to_string(getpid()) + ".3mf") {
    if (!formats::can_write_3mf()) skip_ = true;
  }
  ~Beams() override { std::filesystem::remove(path_); }
  void SetUp() override {
    if (skip_) GTEST_SKIP() << "built without libzip";
  }

  MeshedDesign write(const std::string& text, bool by_material, double tolerance_mm, int threads = 0) {
    Diagnostics diagnostics;
    const LoadedPtr loaded = load_text(text, diagnostics);
    MeshRequest request;
    request.beams = true;
    request.by_material = by_material;
    request.tolerance_mm = tolerance_mm;
    request.threads = threads;
    auto made = loaded ? mesh_design(*loaded, request, diagnostics) : std::nullopt;
    EXPECT_TRUE(made) << to_text(diagnostics);
    if (!made) return {};
    formats::MeshDocument document;
    for (const RegionBody& body : made->bodies) {
      document.materials.push_back({body.region.name, body.colour});
      document.bodies.push_back({body.region.name, body.body.vertices, body.body.triangles});
      document.bodies.back().material = static_cast<uint32_t>(document.bodies.size() - 1);
    }
    MeshedDesign kept = *made;
    add_beams(*made, loaded->design.materials, document);
    formats::write_3mf(path_, document, formats::SlicerFlavour::generic);
    return kept;
  }

  // Compares the voxels of a design with those of the file that was written of it, except within `away_mm` of the
  // border.
  void expect_same_voxels(const std::string& text, bool by_material, double tolerance_mm, double away_mm) {
    write(text, by_material, tolerance_mm);
    const std::string root = "root((-6, -6, -6), (6, 6, 6), (0.0937, 0.0937, 0.0937)) ";
    const Voxels made = slice_text(root + text);
    const Voxels read = slice_text(root + "mesh(\"" + path_ + (by_material ? "\", materials=\"names\");" : "\");"));
    ASSERT_EQ(made.ids.size(), read.ids.size());
    const auto id = [&](const Voxels& voxels, size_t n) {
      return by_material ? voxels.ids[n] : MaterialId{voxels.ids[n] != 0};
    };
    std::vector<Vec3> different;
    size_t inside = 0;
    for (size_t n = 0; n < made.ids.size(); ++n) {
      inside += made.ids[n] != 0;
      if (id(made, n) != id(read, n)) different.push_back(centre(made.lattice, n));
    }
    EXPECT_GT(inside, 500u);
    expect_near_border(text, different, away_mm);
  }

  std::string path_;

 private:
  static Vec3 centre(const voxel::Lattice& lattice, size_t n) {
    const auto [x, y, z] = lattice.count;
    const auto place = static_cast<int64_t>(n);
    const std::array<int64_t, 3> index{place % x, place / x % y, place / (x * y)};
    Vec3 p = lattice.origin;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] +=
          (static_cast<double>(index[static_cast<size_t>(axis)]) + 0.5) * lattice.pitch[static_cast<size_t>(axis)].mm();
    return p;
  }

  static void expect_near_border(const std::string& text, const std::vector<Vec3>& points, double away_mm) {
    Diagnostics diagnostics;
    const LoadedPtr loaded = load_text(text, diagnostics);
    const auto sampler = Sampler::build(loaded->design, {false, true, false, false, {}}, diagnostics);
    ASSERT_TRUE(sampler);
    std::vector<double> distances(points.size());
    sampler->sample(points, std::array{distances.data()});
    for (const double distance : distances) EXPECT_LE(std::abs(distance), away_mm);
  }

  bool skip_ = false;
};

// Rounding of coordinates of some millimetres to floats, and of computations with them; mm.
constexpr double float_rounding = 2e-6;

}  // namespace

TEST_F(Beams, OfStrutsComeBack) {
  expect_same_voxels("lattice(edges=[[(-4, -3, 1), (4.1, 2.7, 0.3)]], radius=0.731);", false, 0.02, float_rounding);
}

TEST_F(Beams, OfTaperedStrutsComeBack) {
  expect_same_voxels("lattice(edges=[[(-4, -3, 1), (4, 2, 0.3)], [(0, 0, -4), (0.5, 0, 4)]], radius=\"1.5 - 1.2*t\");",
                     false, 0.02, float_rounding);
}

TEST_F(Beams, OfStrutsWithFlatEndsComeBack) {
  expect_same_voxels("strut((-4, -3, 1), (4.1, 2.7, 0.3), \"1.2 - t\");", false, 0.02, float_rounding);
}

TEST_F(Beams, OfTilesCutByASphereComeBack) {
  expect_same_voxels("intersection() { sphere(5); tile() lattice(\"octet\", (3, 3, 3), 0.3); }", false, 0.02, 0.02);
}

TEST_F(Beams, WithoutACylinderComeBack) {
  expect_same_voxels("difference() { rotate(10, 20, 30) lattice(\"kelvin\", (7, 7, 7), 0.4); cylinder(1.7, 30); }",
                     false, 0.02, 0.02);
}

TEST_F(Beams, WithoutWhatHasNoEndComeBack) {
  expect_same_voxels("difference() { lattice(\"bcc\", (7, 7, 7), 0.8); function(\"1 - x\"); }", false, 0.02, 0.02);
}

TEST_F(Beams, BesideSolidsComeBack) {
  expect_same_voxels(
      "difference() { union() { cube(4); scale(2, 2, 2) lattice(\"bcc\", (4, 4, 4), 0.3); } translate(2, 0, 0) "
      "cylinder(1, 20); }",
      false, 0.02, 0.02);
}

// Steps have a slope of 0, as no shift has; a shift leaves cells equal boxes.
TEST_F(Beams, OfCellsThatAreShiftedByStepsAreNone) {
  const auto made = [&](const std::string& u) {
    return write("m = formula_cells(u=\"" + u +
                     "\", of=box_cells((5, 5, 5), min=(0, 0, 0), max=(10, 10, 10)));\n"
                     "lattice(\"bcc\", radius=0.8, map=m);",
                 false, 0.1);
  };
  EXPECT_TRUE(made("u + (v > 1)*0.5").beams.empty());
  EXPECT_TRUE(made("u + 0.5*floor(v)").beams.empty());
  EXPECT_FALSE(made("u + 0.5").beams.empty());
}

TEST_F(Beams, OfSeveralMaterialsComeBack) {
  const std::string text =
      "union() { lattice(edges=[[(-4, -3, 1), (4, 3, 1)]], radius=0.5, material=\"red\"); translate(0, 0, -3) "
      "cube(2, \"blue\"); lattice(edges=[[(-4, -3, 3), (4, 3, 3)]], radius=0.5, material=\"green\"); }";
  const MeshedDesign made = write(text, true, 0.02);
  ASSERT_EQ(made.beams.size(), 1u);
  EXPECT_EQ(made.beams[0].materials.size(), 2u);
  // A mesh of a cube is exact.
  expect_same_voxels(text, true, 0.02, float_rounding);
}

TEST_F(Beams, OfTheExampleAreThoseOfItsDesign) {
  const std::string models = source_file("examples/models/beam_lattice");
  write(formats::read_file(models + ".vcad"), false, 0.05);
  Diagnostics diagnostics;
  const auto made = formats::read_mesh(path_, diagnostics), kept = formats::read_mesh(models + ".3mf", diagnostics);
  ASSERT_TRUE(made && kept) << to_text(diagnostics);
  ASSERT_EQ(made->lattices.size(), 1u);
  ASSERT_EQ(kept->lattices.size(), 1u);
  const formats::BeamLattice &a = *made->lattices[0].lattice, &b = *kept->lattices[0].lattice;
  EXPECT_TRUE(a.vertices == b.vertices);
  ASSERT_EQ(a.beams.size(), b.beams.size());
  for (size_t n = 0; n < a.beams.size(); ++n) {
    EXPECT_EQ(a.beams[n].ends, b.beams[n].ends);
    EXPECT_EQ(a.beams[n].radii, b.beams[n].radii);
  }
  EXPECT_TRUE(a.clip->triangles == b.clip->triangles);
}

TEST_F(Beams, AreTheSameOnAnyNumberOfThreads) {
  const std::string text =
      "union() { sphere(2); intersection() { sphere(5); tile() lattice(\"octet\", (3, 3, 3), 0.3); } }";
  write(text, true, 0.05, 1);
  const std::string bytes = formats::read_file(path_);
  write(text, true, 0.05, 3);
  EXPECT_TRUE(bytes == formats::read_file(path_));
}

TEST_F(Beams, HaveTheColourOfTheirMaterials) {
  const MeshedDesign made = write("lattice(\"bcc\", (4, 4, 4), 0.3, material=\"green\");", false, 0.05);
  ASSERT_EQ(made.beams.size(), 1u);
  EXPECT_TRUE(made.beams[0].materials.empty());
  Diagnostics diagnostics;
  EXPECT_EQ(made.beams[0].colour, load_materials("", diagnostics)->find("green")->colour);
}

}  // namespace ombre::compile
