// Images of stacks: PNG, TIFF (of one or more pages) and BMP.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/file_format.h"
#include "base/system/progress.h"
#include "formats/volumes/volume.h"

namespace ombre::sources {

std::vector<FileFormat> image_file_formats();
// Returns true if the name ends like that of a supported image.
bool has_image_name(const std::string& path);
bool is_image(std::string_view bytes);

struct LayerNumbers {
  uint32_t width = 0, height = 0;
  std::string type;             // "uint16"
  int64_t channels = 1;         // values per pixel in the file
  formats::VoxelValues values;  // rows from the top
};

struct LayerColours {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top
};

// Returns the numbers of the pixels of each page as stored: of 8 or 16 bits in PNG, of any type in TIFF. If pixels have
// several values, `channel` selects one; -1 makes them an error. Throws Error and Cancelled.
std::vector<LayerNumbers> read_layer_numbers(const std::string& path, std::string_view bytes, int channel,
                                             const StopFlag* stop);

// Returns the colours of the pixels of each page. Throws Error and Cancelled.
std::vector<LayerColours> read_layer_colours(const std::string& path, std::string_view bytes, const StopFlag* stop);

}  // namespace ombre::sources
