// PNG images: layers of voxels as indexed or RGBA pixels, and plain pixels back again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/image_layout.h"
#include "base/math/run.h"
#include "formats/images/palette.h"

namespace ombre::formats {

struct PngLayout : ImageLayout {
  double dots_per_metre_x = 0, dots_per_metre_y = 0;  // rounded to whole dots; 0 writes none
  MaterialId mask_of = 0;                             // of a mask
};

// The same layer gives the same bytes. Width and height must lie in 1 ... 1,000,000, and every
// material in the palette. Throws Error when memory runs out.
std::string encode_png(const RunLayer& layer, const Palette& palette, const PngLayout& layout);

// Rows from the top, 4 bytes a pixel.
std::string encode_png(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba);

struct DotsPerMetre {
  double x = 0, y = 0;  // rounded to whole dots; 0 writes none
};
// In 65,536 shades of gray, rows from the top.
std::string encode_gray_png(uint32_t width, uint32_t height, const std::vector<uint16_t>& pixels,
                            const DotsPerMetre& resolution);

struct PngImage {
  uint32_t width = 0, height = 0;
  ImageFormat format = ImageFormat::rgba;
  int bit_depth = 8;                                    // as stored; pixels take whole bytes whatever it is
  std::vector<Rgba> palette;                            // of indexed images
  std::vector<uint8_t> pixels;                          // rows from the top: an index, or 4 bytes of RGBA, a pixel
  uint32_t dots_per_metre_x = 0, dots_per_metre_y = 0;  // 0 when the file does not say

  Rgba colour(uint32_t column, uint32_t row) const;
};

// Palette images stay indexed; gray, RGB and 16-bit images become 8-bit RGBA. Throws Error, naming
// `name`, for what is not a whole PNG or has too many pixels, before memory is taken for them.
PngImage decode_png(std::string_view bytes, const std::string& name, uint64_t most_pixels = 1'000'000'000);

struct GrayImage {
  uint32_t width = 0, height = 0;
  std::vector<uint16_t> pixels;  // rows from the top; as stored, so up to 255 where the file has 8 bits
};

// Images in shades of grey, of 1 to 16 bits a pixel; what they hide by transparency counts as well. Throws Error, also
// for images in colour.
GrayImage decode_gray_png(std::string_view bytes, const std::string& name, uint64_t most_pixels = 1'000'000'000);

}  // namespace ombre::formats
