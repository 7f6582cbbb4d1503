// Writes layers of voxels as PNG images of indexed or RGBA pixels, and reads PNG images.
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
  double dots_per_metre_x = 0, dots_per_metre_y = 0;  // rounded to integers; 0 omits it
  MaterialId mask_of = 0;                             // the material of a mask
};

// Encodes a layer; equal layers give equal bytes. Width and height must lie in 1 ... 1,000,000, and all materials must
// be in the palette. Throws Error if memory runs out.
std::string encode_png(const RunLayer& layer, const Palette& palette, const PngLayout& layout);

// Encodes a layer of bytes as shades of gray with 8 bits, or with 1 bit if the bytes are 0 and 1. The layout gives the
// orientation and the resolution. Else as above.
std::string encode_shades_png(const RunLayer& shades, int bits, const PngLayout& layout);

// Encodes a picture with rows from the top and 4 bytes per pixel.
std::string encode_png(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba);

struct DotsPerMetre {
  double x = 0, y = 0;  // rounded to integers; 0 omits it
};
// Encodes a picture in 65,536 shades of gray, rows from the top.
std::string encode_gray_png(uint32_t width, uint32_t height, const std::vector<uint16_t>& pixels,
                            const DotsPerMetre& resolution);
// Encodes a picture in colours, rows from the top, that is never indexed.
std::string encode_rgba_png(uint32_t width, uint32_t height, const std::vector<Rgba>& pixels,
                            const DotsPerMetre& resolution);

struct PngImage {
  uint32_t width = 0, height = 0;
  ImageFormat format = ImageFormat::rgba;
  int bit_depth = 8;                                    // as stored in the file; pixels here are whole bytes
  std::vector<Rgba> palette;                            // for indexed images
  std::vector<uint8_t> pixels;                          // rows from the top; per pixel an index, or 4 bytes of RGBA
  uint32_t dots_per_metre_x = 0, dots_per_metre_y = 0;  // 0 if the file does not specify it

  Rgba colour(uint32_t column, uint32_t row) const;
};

// Decodes an image. Palette images stay indexed; gray, RGB and 16-bit images become 8-bit RGBA. Throws Error, naming
// `name`, if the file is not a complete PNG or has too many pixels, before memory is allocated for them.
PngImage decode_png(std::string_view bytes, const std::string& name, uint64_t most_pixels = 1'000'000'000);

struct GrayImage {
  uint32_t width = 0, height = 0;
  std::vector<uint16_t> pixels;  // rows from the top; as stored, so at most 255 if the file has 8 bits
};

// Decodes an image in shades of gray, of 1 to 16 bits per pixel; transparency is ignored. Throws Error, also for images
// in colour.
GrayImage decode_gray_png(std::string_view bytes, const std::string& name, uint64_t most_pixels = 1'000'000'000);

}  // namespace ombre::formats
