#include "jobs/slice/coverage_layers.h"

#include <cmath>
#include <numbers>

#include "jobs/slice/sl1_files.h"
#include "jobs/test_designs.h"
#include "jobs/test_slices.h"

namespace ombre::compile {
namespace {

Plan covered(const std::string& text, int samples, voxel::Evaluator evaluator = voxel::Evaluator::batch) {
  Diagnostics diagnostics;
  PlanOptions options;
  options.pitch.fill(Pitch::from_mm(0.25));
  options.evaluator = evaluator;
  options.value = ValueChoice{"coverage", {}, 8, samples};
  const LoadedPtr loaded = load_text(text, diagnostics);
  auto plan = loaded ? plan_slice(loaded, options, diagnostics) : std::nullopt;
  EXPECT_TRUE(plan) << to_text(diagnostics);
  return plan.value();
}

std::vector<MaterialId> shades_of(const Plan& plan, int64_t layer, const voxel::TileBox& box) {
  voxel::TileBox region = box;
  region.lo[2] = layer;
  region.hi[2] = layer + 1;
  const std::vector<voxel::LayerResult> layers = plan.regions(region, nullptr);
  const auto& runs = std::get<RunLayer>(layers.front().channels.front());
  std::vector<MaterialId> shades(size_t{runs.width()} * runs.height());
  for (uint32_t j = 0; j < runs.height(); ++j) runs.row(j).unpack(shades.data() + size_t{j} * runs.width());
  return shades;
}

std::vector<MaterialId> shades_of(const Plan& plan, int64_t layer) {
  const auto& count = plan.request.lattice.count;
  return shades_of(plan, layer, {{0, 0, 0}, {count[0], count[1], 0}});
}

double area_of(const Plan& plan, int64_t layer) {
  double shades = 0;
  for (const MaterialId shade : shades_of(plan, layer)) shades += shade;
  return shades / 255 * 0.25 * 0.25;
}

}  // namespace

// The box, and with it the lattice, begins at x = -1.0625. It ends 0.0525 mm into a voxel of 0.25 mm: behind the first
// of four points, and the second of eight.
TEST(CoverageLayers, ShadesAreSharesOfTheVoxel) {
  const std::string box = "translate(-0.0625, 0, 0) rectprism((2, 2, 1), \"red\");";
  const std::string cut = "difference() { " + box + " translate(0.99, 0, 0) rectprism((1, 4, 4)); }";
  for (const auto& [samples, expected] : std::vector<std::pair<int, int>>{{1, 0}, {2, 0}, {4, 64}, {8, 64}}) {
    const std::vector<MaterialId> shades = shades_of(covered(cut, samples), 1);
    EXPECT_EQ(shades[5], 255) << samples;
    EXPECT_EQ(shades[6], expected) << samples;
  }
}

TEST(CoverageLayers, DiscsHaveTheirArea) {
  const Plan plan = covered("cylinder(3.1, 2, \"red\");", 8);
  const double area = std::numbers::pi * 3.1 * 3.1;
  for (int64_t layer = 0; layer < plan.request.lattice.count[2]; ++layer)
    EXPECT_NEAR(area_of(plan, layer), area, 1e-3 * area) << layer;
}

TEST(CoverageLayers, AreTheSameInPiecesAndNearlyByTheReference) {
  const std::string text =
      "intersection() { cube(9, \"red\"); tpms(\"gyroid\", cell=(4, 4, 4), thickness=0.8, material=\"red\"); }";
  const Plan plan = covered(text, 5), reference = covered(text, 5, voxel::Evaluator::reference);
  const auto [width, height, layers] = plan.request.lattice.count;
  const std::vector<MaterialId> whole = shades_of(plan, layers / 2);
  const std::vector<MaterialId> piece = shades_of(plan, layers / 2, {{3, 5, 0}, {17, 30, 0}});
  for (int64_t j = 5; j < 30; ++j)
    for (int64_t i = 3; i < 17; ++i)
      ASSERT_EQ(piece[static_cast<size_t>((j - 5) * 14 + i - 3)], whole[static_cast<size_t>(j * width + i)]);
  const std::vector<MaterialId> exact = shades_of(reference, layers / 2);
  for (size_t n = 0; n < whole.size(); ++n) ASSERT_NEAR(whole[n], exact[n], 255 / 25 + 1) << n;  // one point of 25
  EXPECT_EQ(whole.size(), static_cast<size_t>(width * height));
}

TEST(CoverageLayers, ArchivesNeedAnExposureAndNumbersOfFiveDigits) {
  Plan plan = covered("cube(2, \"red\");", 2);
  Diagnostics diagnostics;
  plan.request.files = *voxel::NamePattern::parse("slice_{index:04}.png");
  check_sl1(plan.request, {}, diagnostics);
  const std::string text = to_text(diagnostics);
  EXPECT_NE(text.find("has no exposure"), std::string::npos) << text;
  EXPECT_NE(text.find("five digits"), std::string::npos) << text;
}

// The times of light fall from 35 to 8 s: 35 + 8 * 3 + ... by hand for two layers between them: 35, 26, 17, 8.
TEST(CoverageLayers, SettingsNameTheLightOfLayers) {
  Plan plan = covered("cube(1, \"red\");", 2);
  plan.request.exposure = voxel::Exposure{8, 35, 2};
  plan.request.files = *voxel::NamePattern::parse("layer{index:05}.png");
  ASSERT_EQ(plan.request.lattice.count[2], 4);
  const std::string text = sl1_files(plan.request, 1).front().second;
  for (const char* line : {"expTime = 8\n", "expTimeFirst = 35\n", "numFade = 2\n", "jobDir = layer\n", "numFast = 4\n",
                           "printTime = 86\n", "layerHeight = 0.25\n", "usedMaterial = 0.001\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

}  // namespace ombre::compile
