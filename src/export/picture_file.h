// Pictures that are drawn pixel by pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/images/png.h"

namespace ombre::exporting {

// A picture with square pixels of 4 bytes of RGBA each, rows from the top.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;

  Picture(uint32_t picture_width, uint32_t picture_height, formats::Rgba colour);
  void set(uint32_t column, uint32_t row, formats::Rgba colour);
};

}  // namespace ombre::exporting
