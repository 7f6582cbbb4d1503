// Images in TIFF files, by libtiff.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/file_format.h"
#include "base/system/progress.h"

namespace ombre::tiff {

struct Page {
  uint32_t width = 0, height = 0;
  uint32_t channels = 1;  // values per pixel, interleaved
  std::string type;       // type of a value: "uint8", "int16", "float32", ...
  std::string bytes;      // rows from the top, little-endian
};

enum class Wanted : uint8_t {
  numbers,  // as stored
  colours   // 8-bit red, green, blue and opacity
};

FileFormat file_format();
// Returns true if the bytes begin like a TIFF file.
bool is_tiff(std::string_view bytes);

// Returns all pages in the file's order. Throws Error, naming `name`, if the file is incomplete or not TIFF, has an
// unknown encoding, has a page of more than 10^9 pixels or numbers other than 8, 16 or 32 bits, and in builds without
// the library. Cancelled once `stop`, which may be null, is set.
std::vector<Page> read_pages(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop);

}  // namespace ombre::tiff
