// Windows bitmaps.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

struct BmpImage {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top, 4 bytes a pixel
};

bool is_bmp(std::string_view bytes);

// Images of 1, 4, 8, 16, 24 or 32 bits a pixel without compression; opaque, but where a mask says where opacity lies.
// Throws Error, naming `name`, for what is no such BMP or has more than 10^9 pixels.
BmpImage decode_bmp(std::string_view bytes, const std::string& name);

}  // namespace ombre::formats
