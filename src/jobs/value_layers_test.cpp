#include "jobs/slice/value_layers.h"

#include <algorithm>
#include <functional>

#include "export/material_stack.h"
#include "formats/images/png.h"
#include "jobs/slice/slice_work.h"
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

// A cuboid from z = -3 to 3 whose dose is 5 + z, and one beside it without a dose.
const std::string dosed =
    "attribute(\"dose\", \"5 + z\", unit=\"J\") { cube(6, \"red\"); } translate(10, 0, 0) { cube(6, \"blue\"); }";

std::optional<Plan> planned(const std::string& text, const ValueChoice& choice, Diagnostics& diagnostics) {
  const LoadedPtr loaded = load_text(text, diagnostics);
  PlanOptions options;
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
      layers[static_cast<size_t>(k)].runs.row(static_cast<uint32_t>(j)).unpack(row.data());
      for (int64_t i = 0; i < lattice.count[0]; ++i) check(lattice.center(i, j, k), row[static_cast<size_t>(i)]);
    }
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
  const auto layers = plan.producer(0, 1, nullptr);
  ASSERT_TRUE(layers[0].lower_bytes);
  exporting::MaterialStack stack = image_stack(plan.request);
  stack.flip_y = false;
  const formats::GrayImage image =
      formats::decode_gray_png(stack.encode_shades(layers[0].runs, *layers[0].lower_bytes), "test");
  ASSERT_EQ(image.width, lattice.count[0]);
  ASSERT_EQ(image.height, lattice.count[1]);
  for (int64_t j = 0; j < lattice.count[1]; ++j)
    for (int64_t i = 0; i < lattice.count[0]; ++i) {
      const int shade = image.pixels[static_cast<size_t>((lattice.count[1] - 1 - j) * lattice.count[0] + i)];
      ASSERT_NEAR(shade, 65535 * (lattice.center(i, j, 0).y + 3) / 6, 0.51);  // with the rounding of floats
    }
  EXPECT_EQ(layers[0].material_counts[0], 0u);
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
  EXPECT_NEAR(plan.request.shades->range.lo, 2, 0.1);
  EXPECT_NEAR(plan.request.shades->range.hi, 8, 0.1);
  EXPECT_EQ(plan.request.shades->unit, "J");
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

}  // namespace ombre::compile
