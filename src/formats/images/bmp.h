// Windows bitmaps.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

struct BmpImage {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top, 4 bytes per pixel
};

bool is_bmp(std::string_view bytes);

// Decodes images of 1, 4, 8, 16, 24 or 32 bits per pixel without compression; they are opaque unless a mask defines
// opacity. Throws Error, naming `name`, for other files and for more than 10^9 pixels.
BmpImage decode_bmp(std::string_view bytes, const std::string& name);

}  // namespace ombre::formats
