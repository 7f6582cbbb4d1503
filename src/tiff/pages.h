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
  uint32_t channels = 1;  // values of a pixel, side by side
  std::string type;       // of a value: "uint8", "int16", "float32", ...
  std::string bytes;      // rows from the top, low byte first
};

enum class Wanted : uint8_t {
  numbers,  // as they are stored
  colours   // red, green, blue and opacity, of 8 bits each
};

// Does the file begin as one of TIFF?
FileFormat file_format();
bool is_tiff(std::string_view bytes);

// All pages, in the file's order. Throws Error, naming `name`: for what is no whole TIFF, is packed in a way that is
// not known, has more than 10^9 pixels in a page or no numbers of 8, 16 or 32 bits, and when this was built without the
// library. Cancelled once `stop`, which may be null, is set.
std::vector<Page> read_pages(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop);

}  // namespace ombre::tiff
