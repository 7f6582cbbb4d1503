#include "formats/images/png.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/text/error.h"
#include "base/text/test_errors.h"

namespace ombre::formats {
namespace {

// Returns a layer with runs of random length and material, including 0.
RunLayer random_layer(uint32_t width, uint32_t height, int materials, uint32_t longest, uint32_t seed) {
  std::mt19937 random(seed);
  RunLayer layer(width);
  for (uint32_t row = 0; row < height; ++row) {
    for (uint32_t filled = 0; filled < width;) {
      const uint32_t length = std::min<uint32_t>(width - filled, 1 + static_cast<uint32_t>(random() % longest));
      layer.add_uniform(static_cast<MaterialId>(random() % static_cast<uint32_t>(materials + 1)), length);
      filled += length;
    }
    layer.end_row();
  }
  return layer;
}

Rgba colour_of(MaterialId id) {
  return {static_cast<uint8_t>(id * 37), static_cast<uint8_t>(255 - id), static_cast<uint8_t>(id / 2), 255};
}

Palette palette_of(int materials) {
  Palette palette;
  for (int id = 1; id <= materials; ++id)
    palette.add(static_cast<MaterialId>(id), colour_of(static_cast<MaterialId>(id)));
  return palette;
}

// Returns the colour that a reader should see for a material.
Rgba seen(MaterialId id, const Palette& palette, const PngLayout& layout) {
  const Rgba colour = palette.colours()[palette.entry(id)];
  const uint8_t gray = layout.format == ImageFormat::mask ? id == layout.mask_of ? 255 : 0 : luminance(colour);
  const bool is_coloured = layout.format == ImageFormat::rgba || layout.format == ImageFormat::indexed;
  return is_coloured ? colour : Rgba{gray, gray, gray, 255};
}

void expect_same_voxels(const RunLayer& layer, const Palette& palette, const PngLayout& layout) {
  const PngImage image = decode_png(encode_png(layer, palette, layout), "test");
  ASSERT_EQ(image.width, layer.width());
  ASSERT_EQ(image.height, layer.height());
  EXPECT_EQ(image.format == ImageFormat::indexed, layout.format == ImageFormat::indexed);
  std::vector<MaterialId> voxels(image.width);
  for (uint32_t row = 0; row < image.height; ++row) {
    layer.row(layout.flip_y ? row : image.height - 1 - row).unpack(voxels.data());
    for (uint32_t column = 0; column < image.width; ++column) {
      const MaterialId id = voxels[layout.flip_x ? image.width - 1 - column : column];
      ASSERT_EQ(image.colour(column, row), seen(id, palette, layout)) << column << ' ' << row;
      if (layout.format == ImageFormat::indexed) {
        ASSERT_EQ(image.pixels[size_t{row} * image.width + column], palette.entry(id));
      }
    }
  }
}

// Checks every format and direction.
void expect_same_voxels(const RunLayer& layer, const Palette& palette) {
  for (const ImageFormat format : {ImageFormat::indexed, ImageFormat::rgba, ImageFormat::gray, ImageFormat::mask}) {
    for (const int flips : {0, 1, 2, 3}) {
      PngLayout layout;
      layout.format = format;
      layout.flip_x = flips & 1;
      layout.flip_y = flips & 2;
      layout.mask_of = palette.ids().back();
      expect_same_voxels(layer, palette, layout);
    }
  }
}

// Returns a layer in which each row has one material more or less than the previous row, or equals it; parts of it are
// dithered.
RunLayer mixed_layer(uint32_t width, uint32_t height, int materials, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<MaterialId> row(width);
  RunLayer layer(width);
  for (uint32_t j = 0; j < height; ++j) {
    const uint32_t begin = static_cast<uint32_t>(random()) % width;
    const uint32_t end = begin + static_cast<uint32_t>(random()) % (width - begin + 1);
    const bool dithered = random() % 3 == 0;
    const auto any = [&] { return static_cast<MaterialId>(random() % static_cast<uint32_t>(materials + 1)); };
    const MaterialId one = any();
    if (random() % 4 == 0) std::fill(row.begin(), row.end(), one);
    if (random() % 4 != 0)
      for (uint32_t i = begin; i < end; ++i) row[i] = dithered ? any() : one;
    layer.append_row(row.data());
  }
  return layer;
}

}  // namespace

TEST(Png, KeepsEveryVoxelAtEveryDepthAndWidth) {
  const std::pair<int, int> depths[] = {{1, 1}, {2, 2}, {3, 2}, {4, 4}, {15, 4}, {16, 8}, {255, 8}};
  for (const auto& [materials, bits] : depths) {
    const Palette palette = palette_of(materials);
    EXPECT_EQ(palette.bit_depth(), bits);
    for (const uint32_t width : {1U, 2U, 3U, 5U, 7U, 8U, 9U, 31U, 64U, 100U}) {
      for (const uint32_t longest : {1U, 3U, 40U}) {
        const RunLayer layer = random_layer(width, 9, materials, longest, width + longest);
        expect_same_voxels(layer, palette);
      }
    }
  }
}

TEST(Png, KeepsEveryVoxelOfMixedLayers) {
  const std::pair<uint32_t, uint32_t> sizes[] = {{1, 50}, {2, 9}, {7, 60}, {33, 100}, {64, 64}, {100, 300}, {333, 200}};
  for (const auto& [width, height] : sizes)
    for (const int materials : {1, 2, 5, 40})
      expect_same_voxels(mixed_layer(width, height, materials, width + height), palette_of(materials));
}

TEST(Png, KeepsRowsThatAreLongerThanAMatchReaches) {
  for (const uint32_t width : {8191U, 8192U, 8193U, 20000U})
    expect_same_voxels(mixed_layer(width, 6, 2, width), palette_of(2));
  expect_same_voxels(mixed_layer(270000, 3, 1, 1), palette_of(1));
}

TEST(Png, KeepsEmptyAndUniformLayers) {
  for (const uint32_t width : {1U, 5U, 8U, 1000U}) {
    for (const MaterialId id : {MaterialId{0}, MaterialId{1}, MaterialId{3}}) {
      RunLayer layer(width);
      for (int j = 0; j < 7; ++j) layer.append_uniform_row(id);
      expect_same_voxels(layer, palette_of(3));
    }
  }
}

// Each place has two of the materials, which vary along the row. At most one bit per voxel is needed to distinguish
// them.
TEST(Png, CodesNoiseOfAFewOfManyMaterialsByTheRowAbove) {
  constexpr uint32_t width = 2048, height = 256;
  for (const int materials : {4, 8, 16, 64, 200}) {
    std::mt19937 random(7);
    RunLayer layer(width);
    std::vector<MaterialId> row(width);
    for (uint32_t j = 0; j < height; ++j) {
      for (uint32_t i = 0; i < width; ++i) {
        const uint32_t place = i * static_cast<uint32_t>(materials - 1), lower = place / width;
        row[i] = static_cast<MaterialId>(1 + lower + (random() % width < place % width ? 1 : 0));
      }
      layer.append_row(row.data());
    }
    const Palette palette = palette_of(materials);
    expect_same_voxels(layer, palette, {});
    // Differences are -1, 0 and 1 with average probabilities of 1/6, 2/3 and 1/6: 1.25 bits.
    const double bits = 8.0 * static_cast<double>(encode_png(layer, palette, {}).size()) / (width * height);
    EXPECT_LT(bits, 1.55) << materials;
  }
}

// The row is void, one material, noise of two in equal shares, and the other material. The noise needs one bit per
// voxel; differences to the row above would need one and a half, although all bytes are as frequent as in a row of
// noise.
TEST(Png, CodesNoiseBetweenStretchesAsItIs) {
  constexpr uint32_t stretch = 1920, noise = 2240, height = 128;
  std::mt19937 random(7);
  RunLayer layer(3 * stretch + noise);
  for (uint32_t j = 0; j < height; ++j) {
    layer.add_uniform(0, stretch);
    layer.add_uniform(1, stretch);
    for (uint32_t i = 0; i < noise; ++i) layer.add_uniform(static_cast<MaterialId>(1 + random() % 2), 1);
    layer.add_uniform(2, stretch);
    layer.end_row();
  }
  const double bits = 8.0 * static_cast<double>(encode_png(layer, palette_of(2), {}).size()) / (noise * height);
  EXPECT_LT(bits, 1.1);
}

TEST(Png, KeepsEveryVoxelOfSmoothLayers) {
  RunLayer layer(200);
  for (uint32_t row = 0; row < 50; ++row) {
    const uint32_t half = 10 + row / 3;
    layer.add_uniform(0, 100 - half);
    layer.add_uniform(1, 2 * half);
    layer.add_uniform(0, 100 - half);
    layer.end_row();
  }
  expect_same_voxels(layer, palette_of(1));
}

TEST(Png, KeepsEveryVoxelOfDitheredLayers) {
  for (const int materials : {1, 2, 3, 4, 5, 7, 15, 16, 40, 255})
    expect_same_voxels(random_layer(500, 100, materials, 1, 1), palette_of(materials));
}

TEST(Png, KeepsEveryVoxelWhereManyEdgesMove) {
  constexpr uint32_t width = 3200, stripe = 80;
  RunLayer layer(width);
  for (uint32_t row = 0; row < 100; ++row) {
    const uint32_t shift = row % 30 == 17 ? 1 : 1 + row * row / 50 % (stripe - 1);
    for (uint32_t begin = 0; begin < width; begin += stripe) {
      layer.add_uniform(static_cast<MaterialId>(begin / stripe % 3), shift);
      layer.add_uniform(static_cast<MaterialId>(begin / stripe % 2), stripe - shift);
    }
    layer.end_row();
  }
  expect_same_voxels(layer, palette_of(2));
}

TEST(Png, DitheredRgbaLayersOfManyMaterialsTakeLittleMoreThanTheirEntropy) {
  constexpr uint32_t side = 1024;
  PngLayout rgba;
  rgba.format = ImageFormat::rgba;
  for (const int materials : {2, 3, 4, 7, 15}) {  // plus void
    const double entropy = std::log2(materials + 1) * side * side / 8;
    const RunLayer layer = random_layer(side, side, materials, 1, 1);
    EXPECT_LT(static_cast<double>(encode_png(layer, palette_of(materials), rgba).size()), 1.7 * entropy) << materials;
  }
}

TEST(Png, SmoothRgbaLayersTakeFewBytesForEachEdge) {
  constexpr uint32_t width = 4096, height = 512, waves = 16;
  RunLayer layer(width);
  for (uint32_t row = 0; row < height; ++row) {
    const double phase = 2 + std::sin(row * 0.02);
    uint32_t filled = 0;
    for (uint32_t edge = 0; edge < waves; ++edge) {
      const auto end = static_cast<uint32_t>((edge + phase / 4) * width / waves);
      layer.add_uniform(static_cast<MaterialId>(edge % 2), end - filled);
      filled = end;
    }
    layer.add_uniform(0, width - filled);
    layer.end_row();
  }
  expect_same_voxels(layer, palette_of(1));
  PngLayout rgba;
  rgba.format = ImageFormat::rgba;
  EXPECT_LT(encode_png(layer, palette_of(1), rgba).size(), 3 * waves * height);
}

// The job has twenty materials: entries keep their numbers, whether few or many bits are used.
TEST(Png, StoresTheFewestBitsThatHoldTheLayer) {
  struct Case {
    MaterialId material;
    int bits;
    size_t entries;
  };
  for (const auto& [material, bits, entries] : {Case{0, 1, 2}, Case{1, 1, 2}, Case{2, 2, 4}, Case{3, 2, 4},
                                                Case{4, 4, 16}, Case{15, 4, 16}, Case{16, 8, 21}, Case{20, 8, 21}}) {
    RunLayer layer(100);
    layer.append_uniform_row(0);
    layer.add_uniform(0, 60);
    layer.add_uniform(material, 3);
    layer.add_uniform(0, 37);
    layer.end_row();
    const PngImage image = decode_png(encode_png(layer, palette_of(20), {}), "test");
    EXPECT_EQ(image.bit_depth, bits);
    EXPECT_EQ(image.palette.size(), entries);
    expect_same_voxels(layer, palette_of(20));
  }
}

TEST(Png, IdsNeedNotBeDense) {
  Palette palette;
  palette.add(7, {1, 2, 3, 255});
  palette.add(200, {4, 5, 6, 255});
  EXPECT_EQ(palette.bit_depth(), 2);
  RunLayer layer(3);
  layer.append_row(std::array<MaterialId, 3>{0, 7, 200}.data());
  expect_same_voxels(layer, palette, {});
}

TEST(Png, VoidIsTransparentUnlessABackgroundIsRequested) {
  const RunLayer layer = random_layer(8, 8, 0, 8, 1);
  for (const ImageFormat format : {ImageFormat::indexed, ImageFormat::rgba}) {
    PngLayout layout;
    layout.format = format;
    EXPECT_EQ(decode_png(encode_png(layer, Palette(), layout), "test").colour(3, 3), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(decode_png(encode_png(layer, Palette({9, 8, 7, 255}), layout), "test").colour(3, 3),
              (Rgba{9, 8, 7, 255}));
  }
}

TEST(Png, SaysTheResolutionOfEachAxis) {
  PngLayout layout;
  layout.dots_per_metre_x = 600 / 0.0254;
  layout.dots_per_metre_y = 300 / 0.0254;
  const PngImage image = decode_png(encode_png(random_layer(4, 4, 1, 2, 1), palette_of(1), layout), "test");
  EXPECT_EQ(image.dots_per_metre_x, 23622U);
  EXPECT_EQ(image.dots_per_metre_y, 11811U);
}

TEST(Png, DitheredLayersTakeLittleMoreThanTheirEntropy) {
  constexpr uint32_t side = 1024;
  for (const double share : {0.5, 0.3, 0.1}) {
    std::mt19937 random(1);
    std::bernoulli_distribution is_first(share);
    RunLayer layer(side);
    for (uint32_t n = 0; n < side * side; ++n) {
      layer.add_uniform(is_first(random) ? 1 : 2, 1);
      if (n % side == side - 1) layer.end_row();
    }
    const double entropy = -(share * std::log2(share) + (1 - share) * std::log2(1 - share)) * side * side / 8;
    EXPECT_LT(static_cast<double>(encode_png(layer, palette_of(2), {}).size()), 1.2 * entropy) << share;
    PngLayout rgba;
    rgba.format = ImageFormat::rgba;
    EXPECT_LT(static_cast<double>(encode_png(layer, palette_of(2), rgba).size()), 2.6 * entropy) << share;
  }
}

TEST(Png, GradedLayersTakeAtMostHalfMoreThanTheirEntropy) {
  constexpr uint32_t side = 1024;
  std::mt19937 random(1);
  RunLayer layer(side);
  double entropy = 0;
  for (uint32_t n = 0; n < side * side; ++n) {
    const double share = (n % side + 0.5) / side;
    entropy -= (share * std::log2(share) + (1 - share) * std::log2(1 - share)) / 8;
    layer.add_uniform(std::bernoulli_distribution(share)(random) ? 1 : 2, 1);
    if (n % side == side - 1) layer.end_row();
  }
  EXPECT_LT(static_cast<double>(encode_png(layer, palette_of(2), {}).size()), 1.5 * entropy);
}

TEST(Png, SameLayerSameBytes) {
  const RunLayer layer = random_layer(333, 77, 5, 9, 3);
  EXPECT_EQ(encode_png(layer, palette_of(5), {}), encode_png(layer, palette_of(5), {}));
}

TEST(Png, PicturesKeepTheirPixels) {
  std::vector<uint8_t> rgba(4 * 5 * 3);
  for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<uint8_t>(i * 11);
  const PngImage few = decode_png(encode_png(5, 3, rgba), "test");
  EXPECT_EQ(few.format, ImageFormat::indexed);
  for (uint32_t n = 0; n < 15; ++n)
    EXPECT_EQ(few.colour(n % 5, n / 5), (Rgba{rgba[4 * n], rgba[4 * n + 1], rgba[4 * n + 2], rgba[4 * n + 3]}));

  std::vector<uint8_t> many(4 * 20 * 20);  // more colours than fit a palette
  for (size_t i = 0; i < many.size(); ++i) many[i] = static_cast<uint8_t>(i % 4 == 0 ? i / 4 : i / 1024 + i % 4);
  EXPECT_EQ(decode_png(encode_png(20, 20, many), "test").pixels, many);
}

TEST(Png, DamagedFilesAreErrorsThatNameTheFile) {
  const std::string whole = encode_png(random_layer(50, 50, 3, 5, 1), palette_of(3), {});
  for (const size_t kept : {size_t{0}, size_t{4}, size_t{20}, whole.size() / 2, whole.size() - 13})
    expect_error([&] { decode_png(std::string_view(whole).substr(0, kept), "layer.png"); }, "layer.png");
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x40);
  EXPECT_THROW(decode_png(flipped, "layer.png"), Error);
}

namespace {

// Computes the checksum by the polynomial of the PNG specification, Annex D.
uint32_t crc_of(std::string_view bytes) {
  uint32_t crc = 0xFFFFFFFF;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xEDB88320U ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

void put(std::string& bytes, size_t at, uint32_t value) {
  for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

// Returns a small file whose header has another size, and optionally interlacing and 16 bits.
std::string with_header(uint32_t width, uint32_t height, int depth, bool is_interlaced) {
  std::string bytes = encode_png(20, 20, std::vector<uint8_t>(4 * 20 * 20, 200));
  constexpr size_t header = 16, length = 13;  // after the signature, a length and "IHDR"
  put(bytes, header, width);
  put(bytes, header + 4, height);
  bytes[header + 8] = static_cast<char>(depth);
  bytes[header + 9] = depth == 16 ? 6 : 3;  // RGBA, or a palette
  bytes[header + 12] = is_interlaced ? 1 : 0;
  put(bytes, header + length, crc_of(std::string_view(bytes).substr(header - 4, length + 4)));
  return bytes;
}

std::string message_of(const std::string& bytes, uint64_t most_pixels) {
  return failure_of([&] { decode_png(bytes, "map.png", most_pixels); });
}

}  // namespace

TEST(Png, SizesAreCheckedBeforeMemoryIsTaken) {
  for (const bool is_interlaced : {false, true})
    for (const int depth : {8, 16}) {
      EXPECT_EQ(message_of(with_header(30'000, 30'000, depth, is_interlaced), uint64_t{1} << 27),
                "cannot read map.png: it has 30,000 x 30,000 pixels, more than 134,217,728");
      EXPECT_EQ(message_of(with_header(10'000, 10'000, depth, is_interlaced), uint64_t{1} << 27),
                "cannot read map.png: not a whole PNG image (the file is too short for 10,000 x 10,000 pixels)");
    }
}

}  // namespace ombre::formats
