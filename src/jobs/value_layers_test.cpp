#include "jobs/slice/value_layers.h"

#include <algorithm>
#include <functional>

#include "export/output_file.h"
#include "formats/images/png.h"
#include "jobs/slice/slice_work.h"
#include "jobs/stacks/job_sheet.h"
#include "jobs/test_designs.h"
#include "jobs/test_slices.h"

namespace ombre::compile {
namespace {

// A cuboid from z = -3 to 3 whose dose is 5 + z, and one beside it without a dose.
const std::string dosed =
    "attribute(\"dose\", \"5 + z\", unit=\"J\") { cube(6, \"red\"); } translate(10, 0, 0) { cube(6, \"blue\"); }";

std::optional<Plan> planned(const std::string& text, const ValueChoice& choice, Diagnostics& diagnostics,
                            PlanOptions options = {}) {
  const LoadedPtr loaded = load_text(text, diagnostics);
  options.pitch.fill(Pitch::from_mm(0.25));
  options.value = choice;
  return loaded ? plan_slice(loaded, options, diagnostics) : std::nullopt;
}

Plan planned(const std::string& text, const ValueChoice& choice) {
  Diagnostics diagnostics;
  const auto plan = planned(text, choice, diagnostics);
  EXPECT_TRUE(plan) << to_text(diagnostics);
  return plan.value();
}

// Calls check(centre, shade) for all voxels.
void for_all(const Plan& plan, const std::function<void(Vec3, int)>& check) {
  const voxel::Lattice& lattice = plan.request.lattice;
  const auto layers = plan.producer(0, lattice.count[2], nullptr);
  std::vector<MaterialId> row(static_cast<size_t>(lattice.count[0]));
  for (int64_t k = 0; k < lattice.count[2]; ++k)
    for (int64_t j = 0; j < lattice.count[1]; ++j) {
      std::get<RunLayer>(layers[static_cast<size_t>(k)].channels[0]).row(static_cast<uint32_t>(j)).unpack(row.data());
      for (int64_t i = 0; i < lattice.count[0]; ++i) check(lattice.center(i, j, k), row[static_cast<size_t>(i)]);
    }
}

// Returns the image of the lowest layer but `k`.
std::string image_of(const Plan& plan, int64_t k) {
  const auto layers = plan.producer(k, k + 1, nullptr);
  const std::vector<std::string> images = encode_layer(plan.request, layers[0].channels, image_stack(plan.request));
  EXPECT_EQ(images.size(), 1u);
  return images.front();
}

}  // namespace

TEST(ValueLayers, ShadesAreLinearBetweenTheEndsOfTheRange) {
  for_all(planned(dosed, {"dose", Interval(3, 7)}), [](Vec3 p, int shade) {
    if (p.x > 3) return;
    const double share = std::clamp((5 + p.z - 3) / 4, 0.0, 1.0);
    ASSERT_NEAR(shade, 255 * share, 0.501) << p.z;
  });
}

// Each layer's image holds the shades, too, with its rows from the greatest y down.
TEST(ValueLayers, ShadesOfSixteenBitsAreFiner) {
  const Plan plan = planned("attribute(\"dose\", \"5 + y\") { cube(6); }", {"dose", Interval(2, 8), 16});
  const voxel::Lattice& lattice = plan.request.lattice;
  ASSERT_EQ(plan.request.channels.front().type, voxel::ChannelType::dose16);
  const formats::GrayImage image = formats::decode_gray_png(image_of(plan, 0), "test");
  ASSERT_EQ(image.width, lattice.count[0]);
  ASSERT_EQ(image.height, lattice.count[1]);
  for (int64_t j = 0; j < lattice.count[1]; ++j)
    for (int64_t i = 0; i < lattice.count[0]; ++i) {
      const int shade = image.pixels[static_cast<size_t>((lattice.count[1] - 1 - j) * lattice.count[0] + i)];
      ASSERT_NEAR(shade, 65535 * (lattice.center(i, j, 0).y + 3) / 6, 0.51);  // with the rounding of floats
    }
  EXPECT_EQ(voxel::count_pixels(plan.producer(0, 1, nullptr)[0].channels[0]).voxels, 24u * 24);
}

TEST(ValueLayers, MasksAreWhiteFromTheMiddleOfTheRangeOn) {
  const std::string graded = "fgrade([\"0.5 + x/12\", \"0.5 - x/12\"], [\"red\", \"blue\"]) { cube(6); }";
  for_all(planned(graded, {"red", std::nullopt, 1}), [](Vec3 p, int bit) { ASSERT_EQ(bit, p.x > 0 ? 1 : 0) << p.x; });
  const Plan plan = planned(dosed, {"dose", Interval(4, 8), 1});
  for_all(plan, [](Vec3 p, int bit) { ASSERT_EQ(bit, p.x < 3 && 5 + p.z > 6 ? 1 : 0) << p.z; });
  EXPECT_EQ(plan.request.format, ImageFormat::mask);
  EXPECT_FALSE(plan.request.files.has_material());  // a mask of one value, not one of each material
  const formats::PngImage image = formats::decode_png(image_of(plan, 23), "test");
  EXPECT_EQ(image.bit_depth, 1);
  EXPECT_EQ(image.colour(2, 2), (formats::Rgba{255, 255, 255, 255}));
  EXPECT_EQ(image.colour(40, 2), (formats::Rgba{0, 0, 0, 255}));
}

// A design of one material everywhere: its mask as a channel has the pixels of its mask as a material.
TEST(ValueLayers, MasksOfAFractionAreThoseOfTheMaterial) {
  Diagnostics diagnostics;
  const std::string ball = "sphere(3, \"red\");";
  PlanOptions options;
  options.pitch.fill(Pitch::from_mm(0.25));
  options.image = ImageFormat::mask;
  const auto materials = plan_slice(load_text(ball, diagnostics), options, diagnostics);
  ASSERT_TRUE(materials) << to_text(diagnostics);
  const Plan fraction = planned(ball, {"red", std::nullopt, 1});
  for (int64_t k = 0; k < 24; ++k) EXPECT_EQ(image_of(*materials, k), image_of(fraction, k)) << k;
}

TEST(ValueLayers, ColoursAreThoseOfTheAttribute) {
  const Plan plan = planned("attribute(\"color_rgba\", [\"0.5 + x/12\", 0.2, 1, \"0.6 + y\"]) { sphere(3); }",
                            {"color_rgba", std::nullopt});
  const voxel::Lattice& lattice = plan.request.lattice;
  EXPECT_EQ(plan.request.format, ImageFormat::rgba);
  const formats::PngImage image = formats::decode_png(image_of(plan, 12), "test");
  EXPECT_EQ(image.format, ImageFormat::rgba);
  EXPECT_EQ(image.dots_per_metre_x, 4000u);
  uint64_t seen = 0;
  for (int64_t j = 0; j < lattice.count[1]; ++j)
    for (int64_t i = 0; i < lattice.count[0]; ++i) {
      const Vec3 p = lattice.center(i, j, 12);
      const formats::Rgba colour =
          image.colour(static_cast<uint32_t>(i), static_cast<uint32_t>(lattice.count[1] - 1 - j));
      if (length(p) > 3) {
        ASSERT_EQ(colour, formats::Rgba{});
        continue;
      }
      ASSERT_NEAR(colour[0], 255 * (0.5 + p.x / 12), 0.501);
      ASSERT_EQ(colour[1], 51);
      ASSERT_EQ(colour[2], 255);
      ASSERT_NEAR(colour[3], 255 * std::clamp(0.6 + p.y, 0.0, 1.0), 0.501);
      seen += colour[3] > 0 ? 1 : 0;
    }
  EXPECT_EQ(voxel::count_pixels(plan.producer(12, 13, nullptr)[0].channels[0]).voxels, seen);
  EXPECT_GT(seen, 100u);
}

TEST(ValueLayers, ColoursHaveNoRange) {
  const std::string red = "attribute(\"color_rgba\", \"#ff0000\") { sphere(3); }";
  for (const ValueChoice& choice : {ValueChoice{"color_rgba", Interval(0, 2)}, {"color_rgba", std::nullopt, 16}}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(planned(red, choice, diagnostics));
    EXPECT_NE(to_text(diagnostics).find("\"color_rgba\" is a colour"), std::string::npos) << to_text(diagnostics);
  }
}

// The dose is below 3 in the lowest four layers of 24 x 24 voxels, and above 7 in the highest four. It is 0 in the 24
// layers of the cuboid beside, which has none.
TEST(ValueLayers, VoxelsBeyondAChosenRangeAreCounted) {
  const Plan plan = planned(dosed, {"dose", Interval(3, 7)});
  EXPECT_EQ(plan.request.check_texts,
            (std::vector<std::string>{"dose is below the range of the images, which begins at 3 J",
                                      "dose is above the range of the images, which ends at 7 J"}));
  CheckSums sums(plan.request);
  for (const voxel::LayerResult& layer : plan.producer(0, plan.request.lattice.count[2], nullptr))
    sums.add(layer.checks);
  const auto reports = sums.reports();
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].voxels, (4u + 24) * 24 * 24);
  EXPECT_EQ(reports[1].voxels, 4u * 24 * 24);
  EXPECT_DOUBLE_EQ(reports[0].first_mm.z, -2.875);
  EXPECT_DOUBLE_EQ(reports[1].first_mm.z, 2.125);
  EXPECT_TRUE(planned(dosed, {"dose", std::nullopt}).request.check_texts.empty());
  EXPECT_TRUE(planned(dosed, {"dose", Interval(3, 7), 1}).request.check_texts.empty());  // a mask has no more values
  const Plan wide = planned(dosed, {"dose", Interval(0, 8)});
  for (const voxel::LayerResult& layer : wide.producer(0, 24, nullptr))
    for (const voxel::CheckHits& hits : layer.checks) EXPECT_EQ(hits.count, 0u);
}

// A layer may have several channels, each with its own image.
TEST_F(Slice, EachChannelHasItsImageAndItsCounts) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(dosed, diagnostics);
  Plan plan = planned(dosed, {"dose", Interval(3, 7)});
  const Plan fine = planned(dosed, {"dose", Interval(3, 7), 16});
  const voxel::Channel mask{"blue", voxel::ChannelType::mask, "", {0, 1}};
  plan.request.channels = {plan.request.channels[0], mask, fine.request.channels[0]};
  plan.request.files = plan.request.files.with_material();
  const auto regions =
      value_layers(loaded->design, plan.request.lattice, plan.request.channels, plan.request.evaluator, diagnostics);
  ASSERT_TRUE(regions) << to_text(diagnostics);
  const LayerProducer producer = whole_layers(*regions, plan.request.lattice);
  const auto made = make_slab(plan.request, producer, image_stack(plan.request), {20, 21});
  ASSERT_EQ(made.size(), 1u);
  ASSERT_EQ(made[0].images.size(), 3u);
  EXPECT_EQ(made[0].images[0], image_of(planned(dosed, {"dose", Interval(3, 7)}), 20));
  EXPECT_EQ(made[0].images[1], image_of(planned(dosed, {"blue", std::nullopt, 1}), 20));
  EXPECT_EQ(made[0].images[2], image_of(fine, 20));
  const uint64_t area = 24 * 24;  // z = 2.125, where the dose of the one cuboid is 7.125
  EXPECT_EQ(made[0].entry.counts.voxels, (std::vector<uint64_t>{area, area, area}));
  EXPECT_EQ(made[0].entry.counts.shades, (std::vector<uint64_t>{area * 255, area * 65535}));

  slice(plan.request, producer, options());
  EXPECT_EQ(contents(folder()).size(), 3 * 24u + 2);
  for (const char* file : {"slice_00020_dose.png", "slice_00020_blue.png", "slice_00020_dose-2.png"})
    EXPECT_TRUE(fs::exists(folder() + "/" + file)) << file;
  EXPECT_EQ(job_json(folder()).find("totals")->find("channels")->list()->size(), 3u);
  EXPECT_EQ(slice(plan.request, producer, options(FolderUse::resume)).layers_kept, 24);
}

TEST(ValueLayers, FormatsThatDoNotTakeTheChannelAreAnError) {
  const auto said = [](const ValueChoice& choice, ImageFormat format) {
    Diagnostics diagnostics;
    PlanOptions options;
    options.image = format;
    EXPECT_FALSE(planned(dosed, choice, diagnostics, options));
    return to_text(diagnostics);
  };
  const std::string indexed = said({"dose", Interval(0, 9)}, ImageFormat::indexed);
  EXPECT_NE(indexed.find("\"indexed\" hold materials, but the layers hold doses of 8 bits of \"dose\""),
            std::string::npos)
      << indexed;
  EXPECT_NE(indexed.find("--format gray"), std::string::npos) << indexed;
  const std::string gray = said({"red", std::nullopt, 1}, ImageFormat::gray);
  EXPECT_NE(gray.find("--format mask"), std::string::npos) << gray;
  Diagnostics diagnostics;
  PlanOptions options;
  options.image = ImageFormat::gray;
  EXPECT_TRUE(planned(dosed, {"dose", Interval(0, 9)}, diagnostics, options)) << to_text(diagnostics);
}

TEST(ValueLayers, SolidsWithoutTheAttributeHaveItsDefault) {
  const std::string with_default = "attribute(\"dose\", 9, default=4) { cube(6); } translate(10, 0, 0) { cube(6); }";
  for_all(planned(with_default, {"dose", Interval(0, 10)}), [](Vec3 p, int shade) {
    if (p.x > 7 && shade != 102) FAIL() << shade;  // 255 * 4 / 10
    if (p.x > 3 && p.x < 7 && shade != 0) FAIL() << shade;
  });
}

TEST(ValueLayers, TheRangeIsThatOfTheValues) {
  const Plan plan = planned("attribute(\"dose\", \"5 + z\", unit=\"J\") { cube(6); }", {"dose", std::nullopt});
  // The range is that of about 48 samples along the part.
  EXPECT_NEAR(plan.request.channels[0].range.lo, 2, 0.1);
  EXPECT_NEAR(plan.request.channels[0].range.hi, 8, 0.1);
  EXPECT_EQ(plan.request.channels[0].unit, "J");
  EXPECT_EQ(plan.request.format, ImageFormat::gray);
}

TEST(ValueLayers, FractionsGoFromNoneToAll) {
  const std::string graded = "fgrade([\"0.5 + x/12\", \"0.5 - x/12\"], [\"red\", \"blue\"]) { cube(6); }";
  for_all(planned(graded, {"red", std::nullopt}),
          [](Vec3 p, int shade) { ASSERT_NEAR(shade, 255 * (0.5 + p.x / 12), 0.501) << p.x; });
}

// Values that are not a number are black.
TEST(ValueLayers, ValuesThatAreNoNumbersAreBlack) {
  for_all(planned("attribute(\"dose\", \"sqrt(z)\") { cube(6); }", {"dose", Interval(0, 1)}), [](Vec3 p, int shade) {
    if (p.z < 0 && shade != 0) FAIL() << shade;
    if (p.z > 1 && shade != 255) FAIL() << shade;
  });
}

TEST(ValueLayers, UnknownValuesAreAnError) {
  Diagnostics diagnostics;
  EXPECT_FALSE(planned(dosed, {"doze", std::nullopt}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("neither a material nor an attribute \"doze\"; did you mean \"dose\"?"),
            std::string::npos)
      << to_text(diagnostics);
}

// The layers of the cuboid whose dose is above 3 are 20 of 24. Their shades grow from layer to layer until the dose
// is 7.
TEST_F(Slice, JobsOfADoseCountItsVoxelsAndItsMean) {
  const Plan plan = planned(dosed, {"dose", Interval(3, 7)});
  const SliceReport report = slice(plan.request, plan.producer, options());
  double sum = 0;
  uint64_t layers = 0;
  for (int64_t k = 0; k < plan.request.lattice.count[2]; ++k) {
    const double z = plan.request.lattice.center(0, 0, k).z;
    const double shade = std::round(255 * std::clamp((z + 2) / 4, 0.0, 1.0));
    sum += shade;
    layers += shade > 0 ? 1 : 0;
  }
  EXPECT_EQ(layers, 20u);
  EXPECT_EQ(report.voxels_inside, 24u * 24 * 20);

  const Data job = job_json(folder());
  EXPECT_FALSE(job.find("materials"));
  const DataMembers channel{{"name", "dose"}, {"type", "dose8"}, {"unit", "J"}, {"range", DataList{3.0, 7.0}}};
  EXPECT_EQ(*job.find("channels"), Data(DataList{channel}));
  const Data& counted = job.find("totals")->find("channels")->list()->front();
  EXPECT_EQ(*counted.find("voxels"), Data(24.0 * 24 * 20));
  EXPECT_NEAR(*counted.find("volume_mm3")->number(), 6 * 6 * 5, 1e-9);
  EXPECT_NEAR(*counted.find("mean")->number(), 3 + 4 * sum / 255 / 20, 1e-9);
  EXPECT_EQ(*counted.find("unit"), Data("J"));
  EXPECT_EQ(*job.find("totals")->find("first_and_last_layer"), Data(DataList{4.0, 23.0}));
}

TEST_F(Slice, JobsOfADoseGoOn) {
  const Plan plan = planned(dosed, {"dose", Interval(3, 7), 16});
  slice(plan.request, plan.producer, options());
  const Contents whole = contents(folder());
  fs::remove(folder() + "/slice_00011.png");
  const SliceReport report = slice(plan.request, plan.producer, options(FolderUse::resume));
  EXPECT_EQ(report.layers_written, 1);
  EXPECT_EQ(report.layers_kept, 23);
  expect_same(whole, contents(folder()));
  const Plan coarse = planned(dosed, {"dose", Interval(3, 7)});
  expect_error([&] { slice(coarse.request, coarse.producer, options(FolderUse::resume)); }, "channels is");
}

TEST_F(Slice, JobsOfADoseByAnEarlierVersionCannotGoOn) {
  const Plan plan = planned(dosed, {"dose", Interval(3, 7)});
  slice(plan.request, plan.producer, options());
  std::string job = formats::read_file(folder() + "/job.json");
  job.replace(job.find("\"channels\""), 10, "\"shades\"");
  write(folder() + "/job.json", job);
  expect_error([&] { slice(plan.request, plan.producer, options(FolderUse::resume)); }, "earlier version of Ombre");
  slice(plan.request, plan.producer, options(FolderUse::replace));
  EXPECT_TRUE(job_json(folder()).find("channels"));
}

TEST_F(Slice, FilesOfADoseHaveItsNameWhereMaterialsHaveTheirs) {
  Diagnostics diagnostics;
  PlanOptions options_of_plan;
  options_of_plan.printer.files = *voxel::NamePattern::parse("slice_{index:05}_{material}.png");
  options_of_plan.printer.format = ImageFormat::mask;
  const auto plan = planned(dosed, {"dose", Interval(3, 7)}, diagnostics, options_of_plan);
  ASSERT_TRUE(plan) << to_text(diagnostics);
  EXPECT_EQ(plan->request.format, ImageFormat::gray);
  slice(plan->request, plan->producer, options());
  EXPECT_TRUE(fs::exists(folder() + "/slice_00000_dose.png"));
  EXPECT_EQ(contents(folder()).size(), 24u + 2);
  slice(plan->request, plan->producer, options(FolderUse::replace));
  EXPECT_EQ(contents(folder()).size(), 24u + 2);
}

// The cuboid without a dose is black, so the sheet is as wide as the other one, from its darkest layer on.
TEST_F(Slice, ContactSheetsShowDoses) {
  const Plan plan = planned(dosed, {"dose", Interval(3, 7)});
  slice(plan.request, plan.producer, options());
  const std::string sheet = contact_sheet(folder(), 20);
  const formats::PngImage image = formats::decode_png(sheet, "sheet");
  uint64_t white = 0, dark = 0;
  for (uint32_t row = 0; row < image.height; ++row)
    for (uint32_t column = 0; column < image.width; ++column) {
      white += image.colour(column, row) == formats::Rgba{255, 255, 255, 255} ? 1 : 0;
      dark += image.colour(column, row) == formats::Rgba{8, 8, 8, 255} ? 1 : 0;  // 255 * 0.125 / 4
    }
  EXPECT_NEAR(static_cast<double>(white) / static_cast<double>(dark), 4, 0.1);  // 4 layers have a dose above 7
}

}  // namespace ombre::compile
