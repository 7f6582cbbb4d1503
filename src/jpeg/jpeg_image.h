// Pictures in JPEG files, by libjpeg-turbo.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/file_format.h"

namespace ombre::jpeg {

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top as they are stored; the opacity is 255
};

FileFormat file_format();
// Returns true if the bytes begin like a JPEG file.
bool is_jpeg(std::string_view bytes);

// Decodes baseline and progressive files in grey, YCbCr or RGB of 8 bits; profiles of colours are not applied. Equal
// bytes give equal pixels on every machine: the transform is the exact one in integers, and colours of fewer pixels
// are interpolated. Throws Error, naming `name`, if the file is incomplete or damaged, has colours of inks (CMYK), has
// more than `most_pixels`, which is checked before memory is allocated for them, and in builds without the library.
Picture decode(const std::string& name, std::string_view bytes, uint64_t most_pixels);

}  // namespace ombre::jpeg
