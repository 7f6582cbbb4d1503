#include "voxel/channel.h"

#include <gtest/gtest.h>

#include "voxel/image_kinds.h"

namespace ombre::voxel {

TEST(Channel, TypesHaveNamesAndBits) {
  EXPECT_EQ(channel_type("dose16"), ChannelType::dose16);
  EXPECT_EQ(channel_type("colour"), ChannelType::colour);
  EXPECT_FALSE(channel_type("gray"));
  EXPECT_EQ(number_bits(), (std::vector<std::string>{"8", "16", "1"}));
  EXPECT_EQ(number_type(1), ChannelType::mask);
  EXPECT_EQ(number_type(8), ChannelType::dose8);
  EXPECT_EQ(number_type(16), ChannelType::dose16);
}

TEST(Channel, ShadesStandForNumbersOfTheRange) {
  const Channel dose{"dose", ChannelType::dose8, "J", {3, 7}};
  EXPECT_EQ(value_of_shade(dose, 0), 3);
  EXPECT_EQ(value_of_shade(dose, 255), 7);
  EXPECT_DOUBLE_EQ(value_of_shade(dose, 127.5), 5);
  EXPECT_DOUBLE_EQ(value_of_shade({"dose", ChannelType::dose16, "J", {0, 65535}}, 1234), 1234);
}

TEST(Channel, CountsLeaveOutWhatIsZero) {
  const auto expect_count = [](const ChannelPixels& pixels, uint64_t voxels, uint64_t shades) {
    EXPECT_EQ(count_pixels(pixels).voxels, voxels);
    EXPECT_EQ(count_pixels(pixels).shades, shades);
  };
  RunLayer runs(100);
  runs.add_uniform(0, 40);
  runs.add_uniform(200, 60);
  runs.end_row();
  expect_count(runs, 60, 12000);
  expect_count(Raster<uint16_t>{2, {0, 300, 65535, 0}}, 2, 65835);
  expect_count(Raster<Colour>{2, {Colour{9, 9, 9, 0}, Colour{0, 0, 0, 1}}}, 1, 0);
  for (const ChannelType type : {ChannelType::material, ChannelType::dose16, ChannelType::colour})
    expect_count(blank_pixels(type, 5, 3), 0, 0);
  EXPECT_EQ(std::get<Raster<Colour>>(blank_pixels(ChannelType::colour, 5, 3)).height(), 3u);
}

TEST(ImageKinds, FormatsHaveNames) {
  EXPECT_EQ(image_format("rgba"), ImageFormat::rgba);
  EXPECT_EQ(image_format("mask"), ImageFormat::mask);
  EXPECT_EQ(to_text(ImageFormat::gray), "gray");
  EXPECT_FALSE(image_format("jpeg"));
}

TEST(ImageKinds, EachTypeHasAFormat) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(image_formats_of(ChannelType::material), (Names{"rgba", "indexed", "gray", "mask"}));
  EXPECT_EQ(image_formats_of(ChannelType::dose8), Names{"gray"});
  EXPECT_EQ(image_formats_of(ChannelType::dose16), Names{"gray"});
  EXPECT_EQ(image_formats_of(ChannelType::mask), Names{"mask"});
  EXPECT_EQ(image_formats_of(ChannelType::colour), Names{"rgba"});
  EXPECT_EQ(format_for(ChannelType::material, ImageFormat::mask), ImageFormat::mask);
  EXPECT_EQ(format_for(ChannelType::dose8, ImageFormat::mask), ImageFormat::gray);
}

}  // namespace ombre::voxel
