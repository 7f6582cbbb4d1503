#include "formats/images/png_chunks.h"

#include <libdeflate.h>

#include <algorithm>
#include <cmath>

#include "base/system/assert.h"

namespace ombre::formats {
namespace {

uint32_t whole_dots(double dots_per_metre) {
  return static_cast<uint32_t>(std::clamp(std::round(dots_per_metre), 0.0, 2147483647.0));
}

}  // namespace

std::string big_endian(uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

PngChunks::PngChunks() : file_("\x89PNG\r\n\x1A\n") {}

void PngChunks::add_header(uint32_t width, uint32_t height, PngColours type, int bit_depth) {
  const char rest[] = {static_cast<char>(bit_depth), static_cast<char>(type), 0, 0, 0};
  add("IHDR", big_endian(width) + big_endian(height) + std::string(rest, sizeof rest));
}

void PngChunks::add_palette(std::span<const Rgba> colours) {
  std::string opaque, alphas;
  size_t alpha_count = 0;
  for (const Rgba& colour : colours) {
    for (size_t i = 0; i < 3; ++i) opaque += static_cast<char>(colour[i]);
    alphas += static_cast<char>(colour[3]);
    if (colour[3] != 255) alpha_count = alphas.size();
  }
  add("PLTE", opaque);
  if (alpha_count > 0) add("tRNS", alphas.substr(0, alpha_count));
}

void PngChunks::add_resolution(double dots_per_metre_x, double dots_per_metre_y) {
  const uint32_t x = whole_dots(dots_per_metre_x), y = whole_dots(dots_per_metre_y);
  const std::string per_metre(1, 1);
  if (x > 0 && y > 0) add("pHYs", big_endian(x) + big_endian(y) + per_metre);
}

void PngChunks::add(std::string_view type, std::initializer_list<std::string_view> data) {
  size_t size = 0;
  uint32_t sum = libdeflate_crc32(0, type.data(), type.size());
  for (const std::string_view part : data) {
    size += part.size();
    if (!part.empty()) sum = libdeflate_crc32(sum, part.data(), part.size());
  }
  ASSERT(type.size() == 4 && size < size_t{1} << 31);
  file_ += big_endian(static_cast<uint32_t>(size));
  file_ += type;
  for (const std::string_view part : data) file_ += part;
  file_ += big_endian(sum);
}

}  // namespace ombre::formats
