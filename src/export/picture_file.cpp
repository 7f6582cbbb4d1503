#include "export/picture_file.h"

namespace ombre::exporting {

Picture::Picture(uint32_t picture_width, uint32_t picture_height, formats::Rgba colour)
    : width(picture_width), height(picture_height), rgba(size_t{4} * picture_width * picture_height) {
  for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = colour[i % 4];
}

void Picture::set(uint32_t column, uint32_t row, formats::Rgba colour) {
  if (column >= width || row >= height) return;
  std::copy(colour.begin(), colour.end(),
            rgba.begin() + static_cast<std::ptrdiff_t>((size_t{row} * width + column) * 4));
}

}  // namespace ombre::exporting
