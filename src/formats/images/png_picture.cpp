// Encodes whole pictures as PNG files. libdeflate takes half of zlib's time for files of the same size, and its bytes
// do not depend on the processor.
#include <libdeflate.h>

#include <array>
#include <cstring>
#include <memory>
#include <new>
#include <unordered_map>

#include "base/system/assert.h"
#include "base/text/error.h"
#include "formats/images/png.h"
#include "formats/images/png_chunks.h"

namespace ombre::formats {
namespace {

constexpr int level = 6;  // the highest level is 12
constexpr size_t most_colours = 256;

// The colours of a picture in the order of their first occurrence, if they are few, and each pixel's number among them.
struct FewColours {
  std::vector<Rgba> colours;
  std::vector<uint8_t> numbers;  // empty if there are too many colours
};

FewColours few_colours(const std::vector<uint8_t>& rgba) {
  FewColours few;
  std::unordered_map<uint32_t, uint8_t> known;
  few.numbers.reserve(rgba.size() / 4);
  for (size_t n = 0; n < rgba.size(); n += 4) {
    Rgba colour;
    uint32_t key = 0;
    std::memcpy(colour.data(), &rgba[n], 4);
    std::memcpy(&key, &rgba[n], 4);
    const auto [entry, is_new] = known.try_emplace(key, static_cast<uint8_t>(known.size()));
    if (is_new && known.size() > most_colours) return {};
    if (is_new) few.colours.push_back(colour);
    few.numbers.push_back(entry->second);
  }
  return few;
}

// Returns the rows, each preceded by the filter byte for none. Flat colours compress better without a filter.
std::string rows_of(const std::vector<uint8_t>& bytes, size_t height) {
  const size_t row_bytes = bytes.size() / height;
  std::string rows;
  rows.reserve((row_bytes + 1) * height);
  for (size_t n = 0; n < bytes.size(); n += row_bytes) {
    rows += '\0';
    rows.append(reinterpret_cast<const char*>(&bytes[n]), row_bytes);
  }
  return rows;
}

std::string compressed(const std::string& bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  ASSERT(!out.empty());
  return out;
}

std::array<uint8_t, 2> file_bytes(uint16_t shade) {
  return {static_cast<uint8_t>(shade >> 8), static_cast<uint8_t>(shade)};
}
const Rgba& file_bytes(const Rgba& colour) { return colour; }

// Returns the rows as differences to the rows above, which are small where pixels vary slowly.
template <class Pixel>
std::string differences_of(const std::vector<Pixel>& pixels, uint32_t width, uint32_t height) {
  constexpr char up = 2;  // number of the filter
  std::string rows;
  rows.reserve((sizeof(Pixel) * width + 1) * height);
  for (size_t row = 0; row < height; ++row) {
    rows += up;
    for (size_t n = row * width; n < (row + 1) * width; ++n) {
      const auto bytes = file_bytes(pixels[n]), above = file_bytes(row > 0 ? pixels[n - width] : Pixel{});
      for (size_t i = 0; i < bytes.size(); ++i) rows += static_cast<char>(bytes[i] - above[i]);
    }
  }
  return rows;
}

void add_data(PngChunks& file, std::string_view data) {
  constexpr size_t largest = size_t{1} << 30;
  for (size_t at = 0; at < data.size(); at += largest) file.add("IDAT", data.substr(at, largest));
}

template <class Pixel>
std::string encode_differences(uint32_t width, uint32_t height, const std::vector<Pixel>& pixels, PngColours type,
                               int bit_depth, const DotsPerMetre& resolution) try {
  ASSERT(!pixels.empty() && pixels.size() == size_t{width} * height);
  PngChunks file;
  file.add_header(width, height, type, bit_depth);
  file.add_resolution(resolution.x, resolution.y);
  add_data(file, compressed(differences_of(pixels, width, height)));
  file.add("IEND", "");
  return file.take();
} catch (const std::bad_alloc&) {
  throw Error(Code::memory, "not enough memory to encode an image; try fewer threads");
}

}  // namespace

// Pictures of at most 256 colours are indexed, which makes files several times smaller.
std::string encode_png(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba) try {
  ASSERT(!rgba.empty() && rgba.size() == size_t{4} * width * height);
  const FewColours few = few_colours(rgba);
  const bool is_indexed = !few.numbers.empty();
  PngChunks file;
  file.add_header(width, height, is_indexed ? PngColours::indexed : PngColours::rgba, 8);
  if (is_indexed) file.add_palette(few.colours);
  file.add("IDAT", compressed(rows_of(is_indexed ? few.numbers : rgba, height)));
  file.add("IEND", "");
  return file.take();
} catch (const std::bad_alloc&) {
  throw Error(Code::memory, "not enough memory to encode an image; try fewer threads");
}

std::string encode_gray_png(uint32_t width, uint32_t height, const std::vector<uint16_t>& pixels,
                            const DotsPerMetre& resolution) {
  return encode_differences(width, height, pixels, PngColours::gray, 16, resolution);
}

std::string encode_rgba_png(uint32_t width, uint32_t height, const std::vector<Rgba>& pixels,
                            const DotsPerMetre& resolution) {
  return encode_differences(width, height, pixels, PngColours::rgba, 8, resolution);
}

}  // namespace ombre::formats
