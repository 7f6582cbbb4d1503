// Tests of the images of a layer: which voxel becomes which pixel, in which colour.
#include "export/image_stack.h"

#include <gtest/gtest.h>

#include "voxel/image_kinds.h"

namespace ombre::exporting {
namespace {

using formats::PngImage;
using formats::Rgba;
using voxel::ChannelType;

constexpr Rgba red{255, 0, 0, 255}, blue{0, 0, 255, 255}, paper{1, 2, 3, 4};

// Returns the settings of a stack of the materials 3 (red) and 7 (blue).
ImageStack red_and_blue(ImageFormat format) {
  ImageStack stack;
  stack.format = format;
  stack.background = paper;
  stack.materials = {{3, red}, {7, blue}};
  return stack;
}

// A layer of three by two voxels; row 0 has the least y.
RunLayer layer_of(const std::array<MaterialId, 3>& front, const std::array<MaterialId, 3>& back) {
  RunLayer layer(3);
  layer.append_row(front.data());
  layer.append_row(back.data());
  return layer;
}

std::vector<Rgba> colours_in(const std::string& png) {
  const PngImage image = formats::decode_png(png, "layer.png");
  EXPECT_EQ(image.width, 3U);
  EXPECT_EQ(image.height, 2U);
  std::vector<Rgba> colours;
  for (uint32_t row = 0; row < image.height; ++row)
    for (uint32_t column = 0; column < image.width; ++column) colours.push_back(image.colour(column, row));
  return colours;
}

}  // namespace

TEST(ImageStack, HasTheGreatestYOnTopUnlessItIsFlipped) {
  const RunLayer layer = layer_of({3, 0, 7}, {0, 3, 3});
  for (const ImageFormat format : {ImageFormat::rgba, ImageFormat::indexed}) {
    ImageStack stack = red_and_blue(format);
    const auto image = [&](bool flip_x, bool flip_y) {
      stack.flip_x = flip_x;
      stack.flip_y = flip_y;
      return colours_in(stack.encode(layer, ChannelType::material).at(0));
    };
    EXPECT_EQ(image(false, false), (std::vector<Rgba>{paper, red, red, red, paper, blue}));
    EXPECT_EQ(image(false, true), (std::vector<Rgba>{red, paper, blue, paper, red, red}));
    EXPECT_EQ(image(true, false), (std::vector<Rgba>{red, red, paper, blue, paper, red}));
    EXPECT_EQ(image(true, true), (std::vector<Rgba>{blue, paper, red, red, red, paper}));
  }
}

TEST(ImageStack, HasAnImageOfEachMaterialInTheirOrder) {
  ImageStack stack = red_and_blue(ImageFormat::indexed);
  stack.files = *voxel::NamePattern::parse("{index}_{material}.png");
  const std::vector<std::string> images = stack.encode(layer_of({3, 0, 7}, {0, 3, 3}), ChannelType::material);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(colours_in(images[0]), (std::vector<Rgba>{paper, red, red, red, paper, paper}));
  EXPECT_EQ(colours_in(images[1]), (std::vector<Rgba>{paper, paper, paper, paper, paper, blue}));
}

TEST(ImageStack, OfMasksIsWhiteWhereTheMaterialIs) {
  ImageStack stack = red_and_blue(ImageFormat::mask);
  stack.files = *voxel::NamePattern::parse("{index}_{material}.png");
  const std::vector<std::string> images = stack.encode(layer_of({3, 0, 7}, {0, 3, 3}), ChannelType::material);
  ASSERT_EQ(images.size(), 2U);
  constexpr Rgba on{255, 255, 255, 255};
  EXPECT_EQ(colours_in(images[0]), (std::vector<Rgba>{mask_off, on, on, on, mask_off, mask_off}));
  EXPECT_EQ(colours_in(images[1]), (std::vector<Rgba>{mask_off, mask_off, mask_off, mask_off, mask_off, on}));
  EXPECT_EQ(formats::decode_png(images[0], "mask.png").bit_depth, 1);
}

// ITU-R BT.601 gives red 76.245, green 149.685 and blue 29.07.
TEST(ImageStack, OfGraysShowsTheLumaOfColours) {
  EXPECT_EQ(shown(red, ImageFormat::gray), (Rgba{76, 76, 76, 255}));
  EXPECT_EQ(shown({0, 255, 0, 10}, ImageFormat::gray), (Rgba{150, 150, 150, 255}));
  EXPECT_EQ(shown(blue, ImageFormat::gray), (Rgba{29, 29, 29, 255}));
  EXPECT_EQ(shown({255, 255, 255, 255}, ImageFormat::gray), (Rgba{255, 255, 255, 255}));
  EXPECT_EQ(shown(paper, ImageFormat::rgba), paper);
  const auto image = red_and_blue(ImageFormat::gray).encode(layer_of({3, 0, 7}, {7, 7, 7}), ChannelType::material);
  const Rgba dark{29, 29, 29, 255};
  // The background's luma is 0.299 + 2 * 0.587 + 3 * 0.114 = 1.8.
  EXPECT_EQ(colours_in(image.at(0)), (std::vector<Rgba>{dark, dark, dark, {76, 76, 76, 255}, {2, 2, 2, 255}, dark}));
}

// 600 dpi are 23622.05 dots per metre, 300 dpi 11811.02.
TEST(ImageStack, SaysHowFinePixelsAre) {
  for (const ChannelType type : {ChannelType::material, ChannelType::dose8, ChannelType::dose16, ChannelType::colour}) {
    ImageStack stack = red_and_blue(voxel::format_for(type, ImageFormat::rgba));
    stack.pitch_x = *Pitch::parse("25.4/600");
    stack.pitch_y = *Pitch::parse("25.4/300");
    const auto images = stack.encode(voxel::blank_pixels(type, 3, 2), type);
    const PngImage image = formats::decode_png(images.at(0), "fine.png");
    EXPECT_EQ(image.dots_per_metre_x, 23622U);
    EXPECT_EQ(image.dots_per_metre_y, 11811U);
  }
}

TEST(ImageStack, OfDosesKeepsEveryShade) {
  ImageStack stack;
  stack.format = ImageFormat::gray;
  const std::vector<uint16_t> on_top{40, 50, 255, 10, 20, 30};
  const auto eight = formats::decode_gray_png(
      stack.encode(layer_of({10, 20, 30}, {40, 50, 255}), ChannelType::dose8).at(0), "dose.png");
  EXPECT_EQ(eight.pixels, on_top);
  const voxel::Raster<uint16_t> raster{3, {1, 256, 65535, 4, 5, 6}};
  const auto pixels = [&](bool flip_x, bool flip_y) {
    stack.flip_x = flip_x;
    stack.flip_y = flip_y;
    return formats::decode_gray_png(stack.encode(raster, ChannelType::dose16).at(0), "dose.png").pixels;
  };
  EXPECT_EQ(pixels(false, false), (std::vector<uint16_t>{4, 5, 6, 1, 256, 65535}));
  EXPECT_EQ(pixels(true, false), (std::vector<uint16_t>{6, 5, 4, 65535, 256, 1}));
  EXPECT_EQ(pixels(false, true), (std::vector<uint16_t>{1, 256, 65535, 4, 5, 6}));
  EXPECT_EQ(pixels(true, true), (std::vector<uint16_t>{65535, 256, 1, 6, 5, 4}));
}

TEST(ImageStack, OfColoursKeepsThemAsTheyAre) {
  ImageStack stack;
  stack.format = ImageFormat::rgba;
  stack.flip_x = true;
  const voxel::Raster<voxel::Colour> raster{3, {red, blue, paper, {0, 0, 0, 0}, {9, 8, 7, 6}, {9, 8, 7, 5}}};
  EXPECT_EQ(colours_in(stack.encode(raster, ChannelType::colour).at(0)),
            (std::vector<Rgba>{{9, 8, 7, 5}, {9, 8, 7, 6}, {0, 0, 0, 0}, paper, blue, red}));
}

}  // namespace ombre::exporting
