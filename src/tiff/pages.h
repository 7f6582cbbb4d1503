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

// The pages, and what the first of them says about all.
struct Document {
  std::vector<Page> pages;
  std::string description;            // empty if there is none
  double pixels_x = 0, pixels_y = 0;  // resolution: pixels for each unit of length, 0 if it is not given
  uint16_t length_unit = 1;           // ResolutionUnit: 1 none, 2 inch, 3 centimetre
  size_t reduced = 0;                 // how many pages were left out: thumbnails, smaller copies and masks
};

enum class Wanted : uint8_t {
  numbers,  // as stored; those of pages with a palette become colours
  indices,  // as stored, also for pages with a palette
  colours   // 8-bit red, green, blue and opacity
};

FileFormat file_format();
// Returns true if the bytes begin like a TIFF file.
bool is_tiff(std::string_view bytes);

// Returns the pages in the file's order; ImageJ's large stacks have one directory for all pages. Throws Error, naming
// `name`, if the file is incomplete or not TIFF, has an unknown encoding, has a page of more than 10^9 pixels or
// numbers other than 8, 16 or 32 bits, and in builds without the library. Cancelled once `stop`, which may be null, is
// set.
Document read_document(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop);
std::vector<Page> read_pages(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop);

}  // namespace ombre::tiff
