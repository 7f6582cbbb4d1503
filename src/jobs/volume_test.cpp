// Tests volumes as solids: whole voxels, and left and right.
#include <gtest/gtest.h>

#include <filesystem>

#include "jobs/probe/probe.h"
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

constexpr std::array<int64_t, 3> label_counts{9, 5, 6};

// Returns labels 0 to 2 in an irregular pattern.
int label_at(int64_t i, int64_t j, int64_t k) { return static_cast<int>((i * 7 + j * 13 + k * k * 5 + i * j) % 3); }

std::string volume_file(const std::string& name, const std::string& header, const std::string& numbers) {
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << "NRRD0004\ndimension: 3\nencoding: ascii\n" << header << "\n\n" << numbers;
  return path;
}

std::string labels_file() {
  std::string numbers;
  for (int64_t k = 0; k < label_counts[2]; ++k)
    for (int64_t j = 0; j < label_counts[1]; ++j)
      for (int64_t i = 0; i < label_counts[0]; ++i) numbers += std::to_string(label_at(i, j, k)) + ' ';
  return volume_file("ombre_labels.nrrd",
                     "type: uint8\nsizes: 9 5 6\nspace: RAS\nspace directions: (0.5,0,0) (0,0.25,0) (0,0,1)\n"
                     "space origin: (-3,1,10)",
                     numbers);
}

// Returns a file of six by two by two voxels with one voxel set, at the end of the first axis, which points to -x.
std::string one_voxel_file(const std::string& space) {
  std::string numbers(2 * 24, '0');
  for (size_t n = 1; n < numbers.size(); n += 2) numbers[n] = ' ';
  numbers[2 * (5 + 6 * (0 + 2 * 1))] = '5';
  return volume_file("ombre_one_voxel.nrrd",
                     "type: short\nsizes: 6 2 2\nspace: " + space +
                         "\nspace directions: (-1,0,0) (0,2,0) (0,0,3)\nspace origin: (10,20,30)",
                     numbers);
}

bool is_inside_at(const std::string& design, Vec3 p) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(design, diagnostics);
  EXPECT_TRUE(loaded) << to_text(diagnostics);
  if (!loaded) return false;
  const auto found = probe(*loaded, {p}, diagnostics);
  return found && found->front().inside;
}

}  // namespace

TEST(Volume, LabelsAreCopiedVoxelForVoxel) {
  const std::string path = labels_file();
  const std::string solids = "union() { volume_solid(\"" + path + "\", \"red\", label=1); volume_solid(\"" + path +
                             "\", \"blue\", label=2); }";
  for (const voxel::Evaluator evaluator : {voxel::Evaluator::batch, voxel::Evaluator::reference}) {
    PlanOptions options;
    options.pitch = {Pitch::from_mm(0.5), Pitch::from_mm(0.25), Pitch::from_mm(1)};
    options.evaluator = evaluator;
    const Voxels voxels = slice_text(solids, options);
    size_t seen = 0;
    for (int64_t k = 0; k < voxels.lattice.count[2]; ++k)
      for (int64_t j = 0; j < voxels.lattice.count[1]; ++j)
        for (int64_t i = 0; i < voxels.lattice.count[0]; ++i) {
          const Vec3 p = voxels.lattice.center(i, j, k);
          const std::array at{std::lround((p.x + 3) / 0.5), std::lround((p.y - 1) / 0.25), std::lround(p.z - 10)};
          const int label = label_at(at[0], at[1], at[2]);
          ASSERT_EQ(voxels.at(i, j, k), label == 1 ? voxels.id("red") : label == 2 ? voxels.id("blue") : 0);
          ++seen;
        }
    EXPECT_EQ(seen, 9u * 5 * 6);
  }
  fs::remove(path);
}

TEST(Volume, LeftStaysLeft) {
  const std::string path = one_voxel_file("left-posterior-superior");
  const auto solid = [&](const std::string& more) { return "volume_solid(\"" + path + "\", label=5" + more + ");"; };
  const Vec3 there{5, 20, 33}, turned{-5, -20, 33};
  for (const std::string more : {"", ", space=\"LPS\""}) {
    EXPECT_TRUE(is_inside_at(solid(more), there));
    EXPECT_FALSE(is_inside_at(solid(more), turned));
    EXPECT_FALSE(is_inside_at(solid(more), {15, 20, 33}));
    EXPECT_FALSE(is_inside_at(solid(more), {5, 22, 33}));
    EXPECT_FALSE(is_inside_at(solid(more), {5, 20, 30}));
  }
  EXPECT_TRUE(is_inside_at(solid(", space=\"RAS\""), turned));
  EXPECT_FALSE(is_inside_at(solid(", space=\"RAS\""), there));
  EXPECT_TRUE(is_inside_at(solid(", origin=(0, 0, 0), spacing=(2, 1, 1)"), {-10, 0, 1}));
  fs::remove(path);
}

// A left-handed space is an error, since it would be mirrored.
TEST(Volume, LeftHandedSpacesAskForAnother) {
  const std::string path = one_voxel_file("left-anterior-superior");
  Diagnostics diagnostics;
  EXPECT_FALSE(load_text("volume_solid(\"" + path + "\", label=5);", diagnostics));
  EXPECT_NE(to_text(diagnostics).find("left-handed"), std::string::npos);
  EXPECT_TRUE(is_inside_at("volume_solid(\"" + path + "\", label=5, space=\"RAS\");", {-5, 20, 33}));
  EXPECT_TRUE(is_inside_at("volume_solid(\"" + path + "\", label=5, space=\"LPS\");", {5, -20, 33}));
  fs::remove(path);
}

TEST(Volume, LevelsCutAtTheirPlace) {
  // The numbers are 0, 10, 20, ... along x, every 2 mm from 1 mm on.
  const std::string path = volume_file(
      "ombre_ramp.nrrd", "type: float\nsizes: 5 1 1\nspacings: 2 1 1\nspace: 3D-right-handed", "0 10 20 30 40");
  const std::string solid = "volume_solid(\"" + path + "\", level=25, origin=(1, 0, 0)";
  EXPECT_TRUE(is_inside_at(solid + ");", {6.01, 0, 0}));
  EXPECT_FALSE(is_inside_at(solid + ");", {5.99, 0, 0}));
  EXPECT_FALSE(is_inside_at(solid + ", above=false);", {6.01, 0, 0}));
  EXPECT_TRUE(is_inside_at(solid + ", above=false);", {5.99, 0, 0}));
  // The grid ends half a voxel beyond its last centre.
  EXPECT_TRUE(is_inside_at(solid + ");", {9.99, 0.49, 0}));
  EXPECT_FALSE(is_inside_at(solid + ");", {10.01, 0, 0}));
  EXPECT_FALSE(is_inside_at(solid + ");", {9.99, 0.51, 0}));
  fs::remove(path);
}

}  // namespace ombre::compile
