// Decodes PNG images by libpng.
#include "formats/images/png.h"

#include <png.h>

#include <csetjmp>
#include <cstring>

#include "base/system/assert.h"
#include "base/system/not_copied.h"
#include "base/text/error.h"
#include "base/text/text.h"

// libpng exits by longjmp, which does not run destructors. So all objects that own memory are members of PngReader,
// outside of the functions that call libpng, which have only trivial local variables.

namespace ombre::formats {
namespace {

constexpr png_uint_32 largest_side = 1'000'000;

struct Failure {
  std::string message;
};

void on_error(png_structp png, png_const_charp message) {
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  try {
    failure->message = message;
  } catch (...) {  // if memory runs out, the message stays empty
  }
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct PngReader : NotCopied {
  Failure failure;
  std::string_view bytes;
  size_t position = 0;
  png_structp png = nullptr;
  png_infop info = nullptr;
  int stored_bit_depth = 0, stored_bits_per_pixel = 0;
  std::vector<png_bytep> rows;

  explicit PngReader(std::string_view from) : bytes(from) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, on_error, on_warning);
    if (png) info = png_create_info_struct(png);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void take(png_structp png, png_bytep data, size_t size) {
  auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
  if (size > reader->bytes.size() - reader->position) png_error(png, "the file ends too early");
  std::memcpy(data, reader->bytes.data() + reader->position, size);
  reader->position += size;
}

// Reads what the file says of its pixels; a failure jumps to where the caller has set the jump.
void read_stored_layout(PngReader& reader) {
  png_set_read_fn(reader.png, &reader, take);
  png_set_user_limits(reader.png, largest_side, largest_side);
  png_read_info(reader.png, reader.info);
  reader.stored_bit_depth = png_get_bit_depth(reader.png, reader.info);
  reader.stored_bits_per_pixel = reader.stored_bit_depth * png_get_channels(reader.png, reader.info);
}

bool read_header(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  read_stored_layout(reader);
  if (png_get_color_type(reader.png, reader.info) == PNG_COLOR_TYPE_PALETTE) {
    png_set_packing(reader.png);
  } else {
    png_set_expand(reader.png);
    png_set_strip_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 255, PNG_FILLER_AFTER);
  }
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

// Reads the header for gray pixels of two bytes each; smaller samples are not scaled.
bool read_gray_header(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  read_stored_layout(reader);
  if (png_get_color_type(reader.png, reader.info) == PNG_COLOR_TYPE_PALETTE)
    png_error(
        reader.png,
        "it has a palette; read the indices of its pixels as labels, by label=1 for example, or one of the values "
        "of its colours by channel=0, up to 3");
  if ((png_get_color_type(reader.png, reader.info) & PNG_COLOR_MASK_COLOR) != 0)
    png_error(reader.png,
              "it is in colour; choose one of its values by channel=0, up to 3, or save it in shades of grey");
  constexpr int byte_bits = 8;
  if (reader.stored_bit_depth < byte_bits) png_set_packing(reader.png);
  if (reader.stored_bit_depth > byte_bits) png_set_swap(reader.png);
  png_set_strip_alpha(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_pixels(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_read_image(reader.png, reader.rows.data());
  png_read_end(reader.png, nullptr);
  return true;
}

std::vector<Rgba> read_palette(PngReader& reader) {
  png_colorp colours = nullptr;
  png_bytep alphas = nullptr;
  int colour_count = 0, alpha_count = 0;
  png_get_PLTE(reader.png, reader.info, &colours, &colour_count);
  png_get_tRNS(reader.png, reader.info, &alphas, &alpha_count, nullptr);
  std::vector<Rgba> palette;
  for (int i = 0; i < colour_count; ++i) {
    const uint8_t alpha = alphas && i < alpha_count ? alphas[i] : uint8_t{255};
    palette.push_back({colours[i].red, colours[i].green, colours[i].blue, alpha});
  }
  return palette;
}

// Checks the size in the header before memory is allocated.
void check_size(const PngReader& reader, uint32_t width, uint32_t height, uint64_t most_pixels,
                const std::string& name) {
  const std::string size = format_count(width) + " x " + format_count(height) + " pixels";
  if (uint64_t{width} * height > most_pixels)
    throw Error(Code::cannot_read,
                "cannot read " + name + ": it has " + size + ", more than " + format_count(most_pixels),
                {{"file", name}});
  // Deflate expands a byte to at most 1032 bytes.
  constexpr double most_inflated = 1040;
  const double stored_bits = double{1} * width * height * reader.stored_bits_per_pixel;
  if (stored_bits / 8 > most_inflated * static_cast<double>(reader.bytes.size()))
    throw Error(Code::cannot_read,
                "cannot read " + name + ": not a whole PNG image (the file is too short for " + size + ")",
                {{"file", name}});
}

void read_dots(PngReader& reader, PngImage& image) {
  png_uint_32 x = 0, y = 0;
  int unit = PNG_RESOLUTION_UNKNOWN;
  png_get_pHYs(reader.png, reader.info, &x, &y, &unit);
  if (unit != PNG_RESOLUTION_METER) return;
  image.dots_per_metre_x = x;
  image.dots_per_metre_y = y;
}

}  // namespace

PngImage decode_png(std::string_view bytes, const std::string& name, uint64_t most_pixels) {
  const auto require_read = [&](bool read, const PngReader& reader) {
    if (!read)
      throw Error(Code::cannot_read, "cannot read " + name + ": not a whole PNG image (" + reader.failure.message + ")",
                  {{"file", name}});
  };
  PngReader reader(bytes);
  if (!reader.png || !reader.info) throw Error(Code::memory, "cannot read " + name + ": not enough memory");
  require_read(read_header(reader), reader);

  PngImage image;
  image.width = png_get_image_width(reader.png, reader.info);
  image.height = png_get_image_height(reader.png, reader.info);
  check_size(reader, image.width, image.height, most_pixels, name);
  const bool indexed = png_get_color_type(reader.png, reader.info) == PNG_COLOR_TYPE_PALETTE;
  image.format = indexed ? ImageFormat::indexed : ImageFormat::rgba;
  image.bit_depth = reader.stored_bit_depth;
  if (indexed) image.palette = read_palette(reader);
  read_dots(reader, image);

  const size_t row_bytes = size_t{image.width} * (indexed ? 1 : 4);
  ASSERT(row_bytes == png_get_rowbytes(reader.png, reader.info));
  image.pixels.resize(row_bytes * image.height);
  for (size_t row = 0; row < image.height; ++row) reader.rows.push_back(image.pixels.data() + row * row_bytes);
  require_read(read_pixels(reader), reader);
  return image;
}

Rgba PngImage::colour(uint32_t column, uint32_t row) const {
  const size_t pixel = size_t{row} * width + column;
  if (format == ImageFormat::indexed) {
    const uint8_t index = pixels[pixel];
    return index < palette.size() ? palette[index] : Rgba{0, 0, 0, 255};  // as browsers do
  }
  const uint8_t* at = pixels.data() + 4 * pixel;
  return {at[0], at[1], at[2], at[3]};
}

GrayImage decode_gray_png(std::string_view bytes, const std::string& name, uint64_t most_pixels) {
  const auto require_read = [&](bool read, const PngReader& reader) {
    if (!read) throw Error(Code::cannot_read, "cannot read " + name + ": " + reader.failure.message, {{"file", name}});
  };
  PngReader reader(bytes);
  if (!reader.png || !reader.info) throw Error(Code::memory, "cannot read " + name + ": not enough memory");
  require_read(read_gray_header(reader), reader);
  GrayImage image{png_get_image_width(reader.png, reader.info), png_get_image_height(reader.png, reader.info), {}};
  check_size(reader, image.width, image.height, most_pixels, name);
  const size_t row_bytes = png_get_rowbytes(reader.png, reader.info), pixel_bytes = row_bytes / image.width;
  std::vector<uint8_t> stored(row_bytes * image.height);
  for (size_t row = 0; row < image.height; ++row) reader.rows.push_back(stored.data() + row * row_bytes);
  require_read(read_pixels(reader), reader);
  image.pixels.resize(size_t{image.width} * image.height);
  for (size_t n = 0; n < image.pixels.size(); ++n) {
    uint16_t value = stored[n * pixel_bytes];
    if (pixel_bytes == 2) std::memcpy(&value, stored.data() + 2 * n, sizeof value);
    image.pixels[n] = value;
  }
  return image;
}

}  // namespace ombre::formats
