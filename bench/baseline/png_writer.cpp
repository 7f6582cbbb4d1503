#include "png_writer.h"

#include <png.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace baseline {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void fail(png_structp, png_const_charp message) { throw std::runtime_error(message); }

}  // namespace

size_t write_png(const std::string& path, const std::vector<uint8_t>& voxels, size_t width,
                 const std::vector<Colour>& colours) {
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "wb"));
  if (!file) throw std::runtime_error("cannot write " + path);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file.get());
  const size_t height = voxels.size() / width;
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, PNG_COLOR_TYPE_RGBA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  std::vector<uint8_t> row(width * 4);
  for (size_t y = height; y-- > 0;) {
    for (size_t x = 0; x < width; ++x) std::memcpy(&row[x * 4], colours[voxels[y * width + x]].data(), 4);
    png_write_row(png, row.data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return static_cast<size_t>(std::ftell(file.get()));
}

}  // namespace baseline
