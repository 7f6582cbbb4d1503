// The module that reads TIFF files by libtiff.
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/text/error.h"
#include "tiff/libtiff_calls.h"

namespace ombre::tiff {
namespace {

static_assert(std::endian::native == std::endian::little, "libtiff gives numbers in the machine's byte order");

constexpr uint64_t most_pixels = 1'000'000'000;
constexpr size_t most_pages = 100'000;

// Bytes in memory, presented to the library as a file.
struct Memory {
  std::string_view bytes;
  uint64_t at = 0;
  std::string first_error;
};

Memory& memory_of(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t size) {
  Memory& file = memory_of(handle);
  const uint64_t left = file.bytes.size() - std::min<uint64_t>(file.at, file.bytes.size());
  const uint64_t count = std::min<uint64_t>(static_cast<uint64_t>(std::max<tmsize_t>(size, 0)), left);
  std::memcpy(to, file.bytes.data() + std::min<uint64_t>(file.at, file.bytes.size()), count);
  file.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek_to(thandle_t handle, toff_t offset, int from) {
  Memory& file = memory_of(handle);
  file.at = from == SEEK_SET ? offset : from == SEEK_CUR ? file.at + offset : file.bytes.size() + offset;
  return file.at;
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of_file(thandle_t handle) { return memory_of(handle).bytes.size(); }

int map_bytes(thandle_t handle, void** begin, toff_t* size) {
  const Memory& file = memory_of(handle);
  *begin = const_cast<char*>(file.bytes.data());  // the library only reads them
  *size = file.bytes.size();
  return 1;
}
void unmap_nothing(thandle_t, void*, toff_t) {}

int keep_error(TIFF*, void* file, const char*, const char* format, va_list values) {
  std::string& first = static_cast<Memory*>(file)->first_error;
  if (!first.empty()) return 1;
  std::array<char, 300> text{};
  std::vsnprintf(text.data(), text.size(), format, values);
  first = text.data();
  while (!first.empty() && (first.back() == '.' || first.back() == '\n')) first.pop_back();
  return 1;
}
int keep_quiet(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct Close {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

class Reading {
 public:
  Reading(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop)
      : name_(name), wanted_(wanted), stop_(stop), file_{bytes, 0, ""} {
    const std::unique_ptr<TIFFOpenOptions, Close> options(TIFFOpenOptionsAlloc());
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, &file_);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
    constexpr tmsize_t most_memory = tmsize_t{16} << 30;
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), most_memory);
    tiff_.reset(TIFFClientOpenExt(name.c_str(), "rm", &file_, read_bytes, write_nothing, seek_to, close_nothing,
                                  size_of_file, map_bytes, unmap_nothing, options.get()));
    if (!tiff_) fail();
  }

  std::vector<Page> run() {
    std::vector<Page> pages;
    do {
      if (stop_ && stop_->requested()) throw Cancelled();
      if (pages.size() == most_pages) fail("it has more than 100000 pages");
      pages.push_back(page());
    } while (TIFFReadDirectory(tiff_.get()) != 0);
    if (!file_.first_error.empty()) fail();
    return pages;
  }

 private:
  [[noreturn]] void fail(const std::string& reason = "") const {
    const std::string why = !reason.empty() ? reason : file_.first_error.empty() ? "it is broken" : file_.first_error;
    throw Error(Code::file_content, "the image \"" + name_ + "\" cannot be read: " + why, {{"file", name_}});
  }

  template <class T>
  T field(uint32_t tag) const {
    T value{};
    TIFFGetFieldDefaulted(tiff_.get(), tag, &value);
    return value;
  }

  Page page() {
    Page result;
    result.width = field<uint32_t>(TIFFTAG_IMAGEWIDTH);
    result.height = field<uint32_t>(TIFFTAG_IMAGELENGTH);
    if (result.width == 0 || result.height == 0) fail("it has a page without pixels");
    if (uint64_t{result.width} * result.height > most_pixels) fail("it has more than 10^9 pixels in a page");
    const auto ink = field<uint16_t>(TIFFTAG_PHOTOMETRIC);
    const bool is_grey = ink == PHOTOMETRIC_MINISBLACK || ink == PHOTOMETRIC_MINISWHITE;
    result.type = type_of_values();
    if (wanted_ == Wanted::colours || (!is_grey && ink != PHOTOMETRIC_RGB) || result.type.empty())
      return colours(std::move(result));
    return numbers(std::move(result), ink == PHOTOMETRIC_MINISWHITE);
  }

  // Returns the type of the values, or an empty text if they are not whole bytes.
  std::string type_of_values() const {
    const auto bits = field<uint16_t>(TIFFTAG_BITSPERSAMPLE), form = field<uint16_t>(TIFFTAG_SAMPLEFORMAT);
    const std::string size = std::to_string(bits);
    if (form == SAMPLEFORMAT_IEEEFP && (bits == 32 || bits == 64)) return "float" + size;
    if (bits != 8 && bits != 16 && bits != 32) return "";
    return (form == SAMPLEFORMAT_INT ? "int" : "uint") + size;
  }

  Page colours(Page page) {
    page.channels = 4;
    page.type = "uint8";
    page.bytes.resize(size_t{4} * page.width * page.height);
    // The library's words have red in their lowest byte, so the order in memory is red, green, blue, opacity.
    const auto raster = std::make_unique<uint32_t[]>(size_t{page.width} * page.height);
    if (TIFFReadRGBAImageOriented(tiff_.get(), page.width, page.height, raster.get(), ORIENTATION_TOPLEFT, 1) == 0)
      fail();
    std::memcpy(page.bytes.data(), raster.get(), page.bytes.size());
    return page;
  }

  Page numbers(Page page, bool is_white_least) {
    page.channels = field<uint16_t>(TIFFTAG_SAMPLESPERPIXEL);
    constexpr uint32_t most_channels = 1000;
    if (page.channels < 1 || page.channels > most_channels) fail("its pixels have no values, or more than 1000");
    if (field<uint16_t>(TIFFTAG_ORIENTATION) != ORIENTATION_TOPLEFT) fail("its rows do not go down from the top left");
    value_bytes_ = field<uint16_t>(TIFFTAG_BITSPERSAMPLE) / 8U;
    is_apart_ = page.channels > 1 && field<uint16_t>(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    page.bytes.resize(uint64_t{page.width} * page.height * page.channels * value_bytes_);
    for (uint32_t n = 0; n < (is_apart_ ? page.channels : 1); ++n) {
      const auto plane = static_cast<uint16_t>(n);
      TIFFIsTiled(tiff_.get()) != 0 ? read_tiles(page, plane) : read_rows(page, plane);
    }
    if (is_white_least && page.type.starts_with("uint"))
      for (char& byte : page.bytes) byte = static_cast<char>(~byte);
    return page;
  }

  // Returns the number of bytes of a pixel's values that are contiguous in the file.
  size_t pixel_bytes(const Page& page) const { return value_bytes_ * (is_apart_ ? 1 : page.channels); }

  void place(Page& page, const char* from, uint32_t row, uint32_t column, uint32_t count, uint16_t plane) const {
    const size_t size = pixel_bytes(page), step = value_bytes_ * page.channels;
    char* to = page.bytes.data() + (size_t{row} * page.width + column) * step + plane * value_bytes_;
    if (size == step) {
      std::memcpy(to, from, count * size);
      return;
    }
    for (uint32_t n = 0; n < count; ++n) std::memcpy(to + n * step, from + n * size, size);
  }

  void read_rows(Page& page, uint16_t plane) {
    const auto row_bytes = static_cast<size_t>(TIFFScanlineSize64(tiff_.get()));
    if (row_bytes < page.width * pixel_bytes(page)) fail();
    std::string line(row_bytes, '\0');
    for (uint32_t row = 0; row < page.height; ++row) {
      if (TIFFReadScanline(tiff_.get(), line.data(), row, plane) < 0) fail();
      place(page, line.data(), row, 0, page.width, plane);
    }
  }

  void read_tiles(Page& page, uint16_t plane) {
    const auto width = field<uint32_t>(TIFFTAG_TILEWIDTH), height = field<uint32_t>(TIFFTAG_TILELENGTH);
    const auto tile_bytes = static_cast<uint64_t>(TIFFTileSize64(tiff_.get()));
    if (width == 0 || height == 0 || tile_bytes < uint64_t{width} * height * pixel_bytes(page) ||
        tile_bytes > most_pixels)
      fail();
    std::string tile(tile_bytes, '\0');
    for (uint32_t row = 0; row < page.height; row += height)
      for (uint32_t column = 0; column < page.width; column += width) {
        if (TIFFReadTile(tiff_.get(), tile.data(), column, row, 0, plane) < 0) fail();
        for (uint32_t n = 0; n < std::min(height, page.height - row); ++n)
          place(page, tile.data() + size_t{n} * width * pixel_bytes(page), row + n, column,
                std::min(width, page.width - column), plane);
      }
  }

  const std::string& name_;
  Wanted wanted_;
  const StopFlag* stop_;
  Memory file_;
  std::unique_ptr<TIFF, Close> tiff_;
  size_t value_bytes_ = 1;
  bool is_apart_ = false;
};

}  // namespace
}  // namespace ombre::tiff

void ombre_read_tiff(const std::string* name, const std::string_view* bytes, ombre::tiff::Wanted wanted,
                     const ombre::StopFlag* stop, std::vector<ombre::tiff::Page>* pages) {
  *pages = ombre::tiff::Reading(*name, *bytes, wanted, stop).run();
}
