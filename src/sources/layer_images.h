// Images of stacks: PNG, TIFF (of one or many pages) and BMP.
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

// Does the name end as one of an image that is read?
bool has_image_name(const std::string& path);
bool is_image(std::string_view bytes);

struct LayerNumbers {
  uint32_t width = 0, height = 0;
  std::string type;             // "uint16"
  int64_t channels = 1;         // values of a pixel in the file
  formats::VoxelValues values;  // rows from the top
};

struct LayerColours {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top
};

// The numbers of the pixels of each page: as the file has them, of 8 or 16 bits in PNG, of any type in TIFF. Of images
// with several values in a pixel `channel` says which; without one (-1) they are an error. Throws Error, Cancelled.
std::vector<LayerNumbers> read_layer_numbers(const std::string& path, std::string_view bytes, int channel,
                                             const StopFlag* stop);

// Their colours.
std::vector<LayerColours> read_layer_colours(const std::string& path, std::string_view bytes, const StopFlag* stop);

}  // namespace ombre::sources
