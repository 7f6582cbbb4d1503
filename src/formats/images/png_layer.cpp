// Encodes layers as PNG files with our own compression. Libraries choose code by processor, and some of them with it
// their output; none uses runs of voxels.
#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "base/text/error.h"
#include "formats/containers/zlib_stream.h"
#include "formats/images/png.h"
#include "formats/images/png_chunks.h"
#include "formats/images/png_rows.h"
#include "formats/images/rgba_rows.h"

namespace ombre::formats {
namespace {

constexpr size_t data_chunk_bytes = size_t{1} << 18;

PngColours colour_type(ImageFormat format) {
  switch (format) {
    case ImageFormat::rgba:
      return PngColours::rgba;
    case ImageFormat::indexed:
      return PngColours::indexed;
    default:
      return PngColours::gray;
  }
}

// Returns the sample of each material, for formats with one number per pixel.
Samples samples(const Palette& palette, const PngLayout& layout) {
  Samples result;
  result.ids = palette.ids();
  if (layout.format == ImageFormat::indexed) result.bit_depth = palette.bit_depth();
  if (layout.format == ImageFormat::mask) result.bit_depth = 1;
  for (const MaterialId id : palette.ids()) {
    const uint8_t entry = palette.entry(id);
    switch (layout.format) {
      case ImageFormat::indexed:
        result.of[id] = entry;
        break;
      case ImageFormat::mask:
        result.of[id] = id == layout.mask_of;
        break;
      default:
        result.of[id] = luminance(palette.colours()[entry]);
    }
  }
  return result;
}

std::vector<MaterialId> occurring(const RunLayer& layer, const Palette& palette) {
  std::array<bool, 256> found{};
  find_materials(layer, [&](MaterialId id) { return found[id] = true; });
  std::vector<MaterialId> result = palette.ids();
  std::erase_if(result, [&](MaterialId id) { return !found[id]; });
  return result;
}

// Returns the part of the palette that fits the least bit depth for the layer's materials.
Palette fitting(const RunLayer& layer, const Palette& palette) {
  int bits = 1;
  find_materials(layer, [&](MaterialId id) {
    bits = std::max(bits, bits_for(size_t{palette.entry(id)} + 1));
    return bits < palette.bit_depth();
  });
  return palette.first(size_t{1} << bits);
}

// Writes the image data in chunks as they become available.
class DataChunks {
 public:
  explicit DataChunks(PngChunks& file) : file_(file) {}

  // Writes a chunk if enough data is available; `share_done` is the share of the image that is encoded, greater than 0.
  void take(DeflateWriter& deflate, double share_done) {
    if (deflate.size() < data_chunk_bytes) return;
    const double expected_bytes = spare * static_cast<double>(deflate.size()) / share_done;
    if (!begin_.empty()) file_.reserve(static_cast<size_t>(std::min(expected_bytes, most_reserved_bytes)));
    write(deflate, "");
  }
  void finish(ZlibStream& stream) {
    stream.deflate.finish();
    write(stream.deflate, big_endian(stream.sum.value()));
  }

 private:
  void write(DeflateWriter& deflate, std::string_view end) {
    file_.add("IDAT", {begin_, {reinterpret_cast<const char*>(deflate.data()), deflate.size()}, end});
    deflate.clear();
    begin_ = "";
  }

  static constexpr double spare = 1.1, most_reserved_bytes = 1 << 24;

  PngChunks& file_;
  std::string_view begin_ = "\x78\x01";  // zlib's header: a window of 32 KiB
};

template <class Rows>
void add_data(PngChunks& file, const RunLayer& layer, bool flip_y, Rows&& rows, ZlibStream& stream) {
  DataChunks data(file);
  for (uint32_t i = 0; i < layer.height(); ++i) {
    rows.put(layer.row(flip_y ? i : layer.height() - 1 - i));
    data.take(stream.deflate, (i + 1.0) / layer.height());
  }
  data.finish(stream);
}

std::string encode_gray(const RunLayer& layer, const Samples& numbers, const PngLayout& layout) {
  PngChunks file;
  ZlibStream stream;
  file.add_header(layer.width(), layer.height(), PngColours::gray, numbers.bit_depth);
  file.add_resolution(layout.dots_per_metre_x, layout.dots_per_metre_y);
  add_data(file, layer, layout.flip_y, PackedRows(layer.width(), numbers, layout.flip_x, stream), stream);
  file.add("IEND", "");
  return file.take();
}

}  // namespace

std::string encode_png(const RunLayer& layer, const Palette& job_palette, const PngLayout& layout) try {
  const PngColours type = colour_type(layout.format);
  const Palette palette = type == PngColours::indexed ? fitting(layer, job_palette) : job_palette;
  const Samples numbers = samples(palette, layout);
  if (type == PngColours::gray) return encode_gray(layer, numbers, layout);
  PngChunks file;
  ZlibStream stream;
  file.add_header(layer.width(), layer.height(), type, numbers.bit_depth);
  if (type == PngColours::indexed) file.add_palette(palette.colours());
  file.add_resolution(layout.dots_per_metre_x, layout.dots_per_metre_y);
  if (type == PngColours::rgba)
    add_data(file, layer, layout.flip_y,
             RgbaRows(layer.width(), palette, occurring(layer, palette), layout.flip_x, stream), stream);
  else
    add_data(file, layer, layout.flip_y, PackedRows(layer.width(), numbers, layout.flip_x, stream), stream);
  file.add("IEND", "");
  return file.take();
} catch (const std::bad_alloc&) {
  throw Error(Code::memory, "not enough memory to encode an image; try fewer threads");
}

std::string encode_shades_png(const RunLayer& shades, int bits, const PngLayout& layout) try {
  Samples numbers;
  numbers.bit_depth = bits;
  for (int shade = 0; shade < 1 << bits; ++shade) {
    numbers.ids.push_back(static_cast<MaterialId>(shade));
    numbers.of[static_cast<size_t>(shade)] = static_cast<uint8_t>(shade);
  }
  return encode_gray(shades, numbers, layout);
} catch (const std::bad_alloc&) {
  throw Error(Code::memory, "not enough memory to encode an image; try fewer threads");
}

}  // namespace ombre::formats
