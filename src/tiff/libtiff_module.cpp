// The module that reads TIFF files by libtiff.
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
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

  Document run() {
    Document document = about();
    for (bool is_first = true; is_first || TIFFReadDirectory(tiff_.get()) != 0; is_first = false) {
      if (stop_ && stop_->requested()) throw Cancelled();
      if (document.pages.size() + document.reduced == most_pages) fail("it has more than 100000 pages");
      if (is_reduced()) {
        ++document.reduced;
        continue;
      }
      document.pages.push_back(page());
    }
    if (!file_.first_error.empty()) fail();
    if (document.pages.empty()) fail("all of its pages are thumbnails or masks");
    const uint64_t images = imagej_images(document.description);
    if (document.pages.size() == 1 && images > 1) add_following(document.pages, images);
    return document;
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

  // Reads what the first page says about the others.
  Document about() const {
    Document document;
    const char* text = nullptr;
    if (TIFFGetField(tiff_.get(), TIFFTAG_IMAGEDESCRIPTION, &text) != 0 && text) document.description = text;
    document.pixels_x = field<float>(TIFFTAG_XRESOLUTION);
    document.pixels_y = field<float>(TIFFTAG_YRESOLUTION);
    document.length_unit = field<uint16_t>(TIFFTAG_RESOLUTIONUNIT);
    return document;
  }

  bool is_reduced() const {
    const auto kind = field<uint32_t>(TIFFTAG_SUBFILETYPE);
    return (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0;
  }

  // Returns the number of images in a description by ImageJ, or 0.
  static uint64_t imagej_images(const std::string& description) {
    constexpr std::string_view key = "\nimages=";
    const size_t at = description.starts_with("ImageJ=") ? description.find(key) : std::string::npos;
    uint64_t images = 0;
    if (at == std::string::npos) return 0;
    const char* begin = description.data() + at + key.size();
    std::from_chars(begin, description.data() + description.size(), images);
    return images;
  }

  // Adds the images that follow the first without directories, as ImageJ writes stacks of more than 4 GiB.
  void add_following(std::vector<Page>& pages, uint64_t images) {
    const Page first = pages.front();
    if (wanted_ == Wanted::colours || is_scaled_ || field<uint16_t>(TIFFTAG_COMPRESSION) != COMPRESSION_NONE)
      fail("its images follow each other without pages of their own; save it with less than 4 GiB");
    const uint64_t size = first.bytes.size(), begin = TIFFGetStrileOffset(tiff_.get(), 0);
    if (images > most_pages || begin > file_.bytes.size() || (file_.bytes.size() - begin) / size < images)
      fail("it is cut off: its description gives " + std::to_string(images) + " images");
    for (uint64_t n = 1; n < images; ++n) {
      if (stop_ && stop_->requested()) throw Cancelled();
      Page page = first;
      page.bytes = std::string(file_.bytes.substr(begin + n * size, size));
      if (TIFFIsByteSwapped(tiff_.get()) != 0 && value_bytes_ > 1)
        for (size_t at = 0; at < size; at += value_bytes_)
          std::reverse(page.bytes.data() + at, page.bytes.data() + at + value_bytes_);
      pages.push_back(std::move(page));
    }
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
    const bool is_index = ink == PHOTOMETRIC_PALETTE && wanted_ == Wanted::indices;
    is_scaled_ = wanted_ == Wanted::colours || (!is_grey && !is_index && ink != PHOTOMETRIC_RGB) || result.type.empty();
    if (is_scaled_) return colours(std::move(result));
    return numbers(std::move(result), ink == PHOTOMETRIC_MINISWHITE);
  }

  // Returns the type of the values, or an empty text if they are not whole bytes.
  std::string type_of_values() const {
    const auto bits = field<uint16_t>(TIFFTAG_BITSPERSAMPLE), form = field<uint16_t>(TIFFTAG_SAMPLEFORMAT);
    const std::string size = std::to_string(bits);
    if (form == SAMPLEFORMAT_COMPLEXINT || form == SAMPLEFORMAT_COMPLEXIEEEFP) fail("its numbers are complex");
    if (form == SAMPLEFORMAT_IEEEFP && bits != 32 && bits != 64)
      fail("its numbers are floats of " + size + " bits; save it as floats of 32 bits");
    if (form == SAMPLEFORMAT_IEEEFP && (bits == 32 || bits == 64)) return "float" + size;
    if (bits == 64 && form != SAMPLEFORMAT_IEEEFP)
      fail("its numbers are integers of 64 bits; save it as integers of 8 to 32 bits");
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
  bool is_scaled_ = false;  // true if the library turned the page's numbers into colours
};

}  // namespace
}  // namespace ombre::tiff

void ombre_read_tiff(const std::string* name, const std::string_view* bytes, ombre::tiff::Wanted wanted,
                     const ombre::StopFlag* stop, ombre::tiff::Document* document) {
  *document = ombre::tiff::Reading(*name, *bytes, wanted, stop).run();
}
