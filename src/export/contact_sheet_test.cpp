#include "export/contact_sheet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "export/test_folder.h"

namespace ombre::exporting {
namespace {

using formats::Rgba;

constexpr Rgba clear{0, 0, 0, 0}, crimson{220, 20, 60, 255}, navy{0, 0, 128, 255}, green{0, 128, 0, 255};

// The pixels that a colour covers.
struct Patch {
  uint32_t left = UINT32_MAX, top = UINT32_MAX, right = 0, bottom = 0;
  size_t pixels = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
  bool is_full() const { return pixels > 0 && pixels == size_t{right - left} * (bottom - top); }
};

Rgba colour_at(const Picture& picture, uint32_t column, uint32_t row) {
  const uint8_t* from = picture.rgba.data() + (size_t{row} * picture.width + column) * 4;
  return {from[0], from[1], from[2], from[3]};
}

Patch patch_of(const Picture& sheet, Rgba colour) {
  Patch patch;
  for (uint32_t row = 0; row < sheet.height; ++row)
    for (uint32_t column = 0; column < sheet.width; ++column) {
      if (colour_at(sheet, column, row) != colour) continue;
      patch.left = std::min(patch.left, column);
      patch.right = std::max(patch.right, column + 1);
      patch.top = std::min(patch.top, row);
      patch.bottom = std::max(patch.bottom, row + 1);
      ++patch.pixels;
    }
  return patch;
}

Rgba middle_of(const Picture& sheet, const Patch& patch) {
  return colour_at(sheet, (patch.left + patch.right) / 2, (patch.top + patch.bottom) / 2);
}

class ContactSheets : public FolderTest {
 protected:
  // Writes an image that is clear but for a block of a colour.
  std::string image(const std::string& name, uint32_t width, uint32_t height, Patch block, Rgba colour) const {
    Picture picture(width, height, clear);
    for (uint32_t row = block.top; row < block.bottom; ++row)
      for (uint32_t column = block.left; column < block.right; ++column) picture.set(column, row, colour);
    put(name, formats::encode_png(width, height, picture.rgba));
    return path(name);
  }
};

}  // namespace

TEST_F(ContactSheets, ShowWhatAnyLayerHasInTrueProportions) {
  // Together, the layers have material in 30 x 20 pixels, of 0.1 mm x 0.9 mm: 3 mm x 18 mm.
  const std::vector<SheetLayer> layers{{{{image("a.png", 100, 90, {50, 40, 80, 50}, crimson), {}}}, 0, 0.1},
                                       {{{image("b.png", 100, 90, {50, 50, 80, 60}, navy), {}}}, 1, 0.2}};
  const Picture sheet = draw_contact_sheet(layers, {0.1, 0.9, clear});
  EXPECT_LE(sheet.width, 1600U);
  ASSERT_EQ(sheet.rgba.size(), size_t{4} * sheet.width * sheet.height);
  const Patch upper = patch_of(sheet, crimson), lower = patch_of(sheet, navy);
  ASSERT_TRUE(upper.is_full());
  ASSERT_TRUE(lower.is_full());
  // Each fills half of its tile: 3 mm x 9 mm. The second stands to the right of the first, its half below.
  for (const Patch& patch : {upper, lower}) EXPECT_NEAR(patch.height() / patch.width(), 3, 0.05);
  EXPECT_LT(upper.right, lower.left);
  EXPECT_EQ(upper.bottom, lower.top);
}

TEST_F(ContactSheets, OfEmptyLayersShowThemWhole) {
  const std::string file = image("a.png", 40, 10, {0, 0, 0, 0}, crimson);
  const Picture sheet = draw_contact_sheet({{{{file, {}}}, 0, 0}}, {0.1, 4, clear});
  EXPECT_LE(sheet.width, 1600U);
  EXPECT_GT(sheet.width, 40U);
  EXPECT_GT(sheet.height, sheet.width);
  EXPECT_EQ(patch_of(sheet, crimson).pixels, 0U);
}

TEST_F(ContactSheets, MixPixelsThatAreSmallerThanTheirs) {
  constexpr Rgba red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  // Columns of red and blue alternate, finer than the sheet, and so do columns of red and of nothing.
  Picture stripes(4000, 40, red), gaps(4000, 40, red);
  for (uint32_t row = 0; row < 40; ++row)
    for (uint32_t column = 1; column < 4000; column += 2) {
      stripes.set(column, row, blue);
      gaps.set(column, row, clear);
    }
  put("stripes.png", formats::encode_png(4000, 40, stripes.rgba));
  put("gaps.png", formats::encode_png(4000, 40, gaps.rgba));
  const SheetStyle style{0.1, 100, clear};
  const Picture mixed = draw_contact_sheet({{{{path("stripes.png"), {}}}, 0, 0}}, style);
  const Rgba middle = colour_at(mixed, mixed.width / 2, mixed.height / 4);
  // At least two columns lie under a pixel, so red takes between a third and two thirds of it, and blue the rest.
  EXPECT_GE(middle[0], 84);
  EXPECT_LE(middle[0], 171);
  EXPECT_EQ(middle[1], 0);
  EXPECT_NEAR(middle[0] + middle[2], 255, 1);
  const Picture lighter = draw_contact_sheet({{{{path("gaps.png"), {}}}, 0, 0}}, style);
  const Rgba light = colour_at(lighter, lighter.width / 2, lighter.height / 4);
  EXPECT_GT(light[0], light[1]);
  EXPECT_GT(light[1], 50);
}

TEST_F(ContactSheets, LayImagesOverEachOtherInTheirInks) {
  const Patch whole{0, 0, 10, 10}, middle{3, 3, 7, 7};
  const std::string below = image("below.png", 10, 10, whole, crimson),
                    above = image("above.png", 10, 10, middle, navy);
  const SheetStyle style{0.1, 1, clear};
  const Picture own = draw_contact_sheet({{{{below, {}}, {above, {}}}, 0, 0}}, style);
  EXPECT_NEAR(patch_of(own, navy).width() / patch_of(own, crimson).width(), 0.4, 0.01);
  EXPECT_EQ(middle_of(own, patch_of(own, crimson)), navy);
  const Picture inked = draw_contact_sheet({{{{below, {}}, {above, green}}, 0, 0}}, style);
  EXPECT_EQ(middle_of(inked, patch_of(inked, crimson)), green);
  const Picture covered = draw_contact_sheet({{{{above, {}}, {below, {}}}, 0, 0}}, style);
  EXPECT_EQ(patch_of(covered, navy).pixels, 0U);
  const Picture alone = draw_contact_sheet({{{{above, green}}, 0, 0}}, style);
  EXPECT_TRUE(patch_of(alone, green).is_full());
}

TEST_F(ContactSheets, HaveATileForEachOfManyLayers) {
  std::vector<SheetLayer> layers;
  for (int n = 0; n < 7; ++n) {
    const Rgba colour{static_cast<uint8_t>(10 + n), 0, 0, 255};
    layers.push_back({{{image(std::to_string(n) + ".png", 5, 5, {0, 0, 5, 5}, colour), {}}}, n, 0});
  }
  const Picture sheet = draw_contact_sheet(layers, {0.1, 1, clear});
  EXPECT_LE(sheet.width, 1600U);
  const Patch first = patch_of(sheet, {10, 0, 0, 255});
  for (int n = 0; n < 7; ++n) {
    const Patch tile = patch_of(sheet, {static_cast<uint8_t>(10 + n), 0, 0, 255});
    EXPECT_TRUE(tile.is_full()) << n;
    EXPECT_EQ(tile.width(), first.width()) << n;
    EXPECT_EQ(tile.height(), first.height()) << n;
  }
}

TEST_F(ContactSheets, ThatCannotBeDrawnNameTheFile) {
  const std::string first = image("first.png", 10, 10, {0, 0, 10, 10}, crimson);
  const std::string wider = image("wider.png", 11, 10, {0, 0, 10, 10}, crimson);
  put("torn.png", "\x89PNG\r\n");
  const auto message = [&](const std::string& second, bool is_same_layer) {
    std::vector<SheetLayer> layers{{{{first, {}}}, 0, 0}};
    if (is_same_layer)
      layers[0].images.push_back({second, {}});
    else
      layers.push_back({{{second, {}}}, 1, 0});
    return failure_of([&] { draw_contact_sheet(layers, {0.1, 1, clear}); });
  };
  for (const bool is_same_layer : {false, true}) {
    EXPECT_EQ(message(wider, is_same_layer), wider + " has another size than the layers before it");
    EXPECT_NE(message(path("torn.png"), is_same_layer).find("torn.png"), std::string::npos);
    EXPECT_NE(message(path("none.png"), is_same_layer).find("none.png"), std::string::npos);
  }
}

}  // namespace ombre::exporting
