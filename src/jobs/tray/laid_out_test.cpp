#include "jobs/tray/laid_out.h"

#include <algorithm>

#include "base/text/json.h"
#include "jobs/stacks/test_stacks.h"
#include "load/load.h"

namespace ombre::compile {
namespace {

class Tray : public StackTest {
 protected:
  Tray() {
    printer_.title = "a small machine";
    printer_.pitch = {Pitch{1, 10}, Pitch{1, 5}, Pitch{1, 10}};
    printer_.build_mm = Vec3{12, 10, 5};
    options_.printer = printer_;
    options_.pitch = {Pitch{1, 10}, Pitch{1, 5}, Pitch{1, 10}};
  }

  std::optional<TrayDesign> lay_out(const std::vector<std::pair<std::string, int64_t>>& texts) {
    std::vector<TrayItem> items;
    for (const auto& [text, count] : texts)
      items.push_back({std::string(1, static_cast<char>('a' + items.size())), load(text), count});
    return laid_out(items, printer_, 1, diagnostics_);
  }
  std::vector<voxel::LayerResult> layers(const Plan& planned) {
    planned.stages->prepare({});
    return planned.producer(0, planned.request.lattice.count[2], nullptr);
  }
  static std::vector<MaterialId> row(const voxel::LayerResult& layer, int64_t j) {
    std::vector<MaterialId> voxels(layer.materials().width());
    layer.materials().row(static_cast<uint32_t>(j)).unpack(voxels.data());
    return voxels;
  }

  voxel::Printer printer_;
  Diagnostics diagnostics_;
};

// A bowl with a ball in it, without mixtures, which are drawn anew at each place.
constexpr const char* bowl =
    "translate(3, 1, 7) union() {"
    "  difference() { sphere(1.43, red); translate(0.5, 0.3, 0.2) sphere(1.1, red); }"
    "  translate(0.5, 0.3, 0.2) sphere(0.6, blue); }";

TEST_F(Tray, EachCopyHasTheVoxelsOfThePartAlone) {
  const auto design = lay_out({{bowl, 3}, {"cylinder(0.5, 2, green);", 2}});
  ASSERT_TRUE(design) << to_text(diagnostics_);
  EXPECT_EQ(design->parts, (std::vector<std::string>{"a_1", "a_2", "a_3", "b_1", "b_2"}));

  const Plan alone = plan(load(bowl));
  const auto expected = layers(alone);
  const LoadedPtr loaded = load_text(print_json(design->file), "tray.json", {}, diagnostics_);
  ASSERT_TRUE(loaded) << to_text(diagnostics_);
  options_.whole_tray = true;
  const Plan tray = plan(loaded);
  EXPECT_EQ(tray.request.lattice.count, (std::array<int64_t, 3>{120, 50, 29}));
  const auto all = layers(tray);
  const auto& count = alone.request.lattice.count;
  // Copies stand at the least corners where the voxels of the part are found.
  int found = 0;
  for (int64_t y = 0; y + count[1] <= 50; ++y)
    for (int64_t x = 0; x + count[0] <= 120; ++x) {
      bool is_same = true;
      for (int64_t k = 0; k < count[2] && is_same; ++k)
        for (int64_t j = 0; j < count[1] && is_same; ++j) {
          const auto there = row(all[static_cast<size_t>(k)], y + j), here = row(expected[static_cast<size_t>(k)], j);
          is_same = std::equal(here.begin(), here.end(), there.begin() + x);
        }
      found += is_same ? 1 : 0;
    }
  EXPECT_EQ(found, 3);
}

TEST_F(Tray, WhatDoesNotFitIsAnErrorThatSaysHowManyFit) {
  // Boxes of 3 x 3 mm with gaps of 1 mm: three fit along 12 mm, and two along 10 mm.
  EXPECT_TRUE(lay_out({{"rectprism([3, 3, 3], red);", 6}}));
  EXPECT_FALSE(lay_out({{"rectprism([3, 3, 3], red);", 7}}));
  EXPECT_NE(to_text(diagnostics_).find("of 7 parts 6 fit onto the tray of a small machine, 12 x 10 mm"),
            std::string::npos)
      << to_text(diagnostics_);
}

TEST_F(Tray, PartsThatAreTooHighAreRefused) {
  EXPECT_FALSE(lay_out({{"rectprism([3, 3, 5.1], red);", 1}}));
  EXPECT_NE(to_text(diagnostics_).find("a is 5.1 mm high"), std::string::npos);
}

}  // namespace
}  // namespace ombre::compile
